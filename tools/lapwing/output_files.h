#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lapwing::cli {

/// Checks the input and output files of a command before the command begins its work. Rejects paths
/// that cannot be written, and files that are used for two purposes.
class OutputFiles {
 public:
  /// Adds an input file. `name` is the flag or argument of the file, for messages. Ignores empty
  /// paths. If `replaced` is true, an output mesh may replace the file.
  void reads(const std::string& name, const std::filesystem::path& path, bool replaced = false);
  /// Adds an output file. Throws CLI::ValidationError if `path` is an input or another output.
  /// Throws IoError if the file cannot be written.
  void writes(const std::string& name, const std::filesystem::path& path);
  /// Adds an output mesh, which may replace an input with `replaced`. Also throws InputError if the
  /// extension is not a mesh format.
  void writes_mesh(const std::string& name, const std::filesystem::path& path);
  /// Adds an output image. Also throws CLI::ValidationError if the name does not end in .png.
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
