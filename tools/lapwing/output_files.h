#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lapwing::cli {

/// Checks the input and output files of a command before its work. An unwritable path, or one file
/// for two purposes, is an error at once.
class OutputFiles {
 public:
  /// `name` is the flag or argument of the file, for messages. Empty paths are ignored. An output
  /// mesh may replace an input with `replaced`.
  void reads(const std::string& name, const std::filesystem::path& path, bool replaced = false);
  /// Throws CLI::ValidationError if `path` is an input or another output, and IoError if no file
  /// can be written there.
  void writes(const std::string& name, const std::filesystem::path& path);
  /// The same for a mesh, which may replace the mesh that it was made from. Throws InputError for
  /// an extension that is not a mesh format.
  void writes_mesh(const std::string& name, const std::filesystem::path& path);
  /// The same for a picture, whose name must end in .png.
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
