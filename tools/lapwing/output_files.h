#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lapwing::cli {

/// The files that a command reads and is to write, looked at before its work: a place that takes no
/// file, or one file for two purposes, is told at once and not when the work is done.
class OutputFiles {
 public:
  /// `name` is what messages call it, as the flag or argument that names it. Empty paths are none.
  /// A mesh that is written may go over one that is `replaced`.
  void reads(const std::string& name, const std::filesystem::path& path, bool replaced = false);
  /// Throws CLI::ValidationError where `path` is read, or another output goes there, and IoError
  /// where no file can be put.
  void writes(const std::string& name, const std::filesystem::path& path);
  /// The same for a mesh, which may go over the mesh that it was made from. Throws InputError for
  /// an extension that is no mesh's.
  void writes_mesh(const std::string& name, const std::filesystem::path& path);
  /// The same for a picture, whose name ends in .png.
  void writes_picture(const std::string& name, const std::filesystem::path& path);

 private:
  struct File {
    std::string name;
    std::filesystem::path path;
    bool is_replaceable = false;
  };
  void add(const std::string& name, const std::filesystem::path& path, bool is_mesh);

  std::vector<File> read_;
  std::vector<File> written_;
};

}  // namespace lapwing::cli
