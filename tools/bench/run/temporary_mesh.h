#pragma once

#include <filesystem>
#include <string>
#include <unistd.h>

#include "lapwing/io/mesh_file.h"

namespace lapwing::bench {

/// A mesh file for as long as it is needed, beside those of other processes.
class TemporaryMesh {
 public:
  /// The extension, ".obj", says in which format.
  TemporaryMesh(const Mesh& mesh, const std::string& extension)
      : path_(std::filesystem::temp_directory_path() /
              ("lapwing-bench-" + std::to_string(getpid()) + extension)) {
    write_mesh(mesh, path_);
  }
  ~TemporaryMesh() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryMesh(const TemporaryMesh&) = delete;
  TemporaryMesh& operator=(const TemporaryMesh&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace lapwing::bench
