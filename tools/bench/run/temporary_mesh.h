#pragma once

#include <filesystem>
#include <string>
#include <unistd.h>

#include "lapwing/io/mesh_file.h"

namespace lapwing::bench {

/// A temporary mesh file. Its name contains the process id.
class TemporaryMesh {
 public:
  /// Writes the mesh in the format of `extension`, such as ".obj".
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
