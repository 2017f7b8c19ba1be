#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Where the meshes that recipes name come from: from memory if one was put there under its name,
/// else from a file, which is read once and kept while it is among the last few asked for. A file
/// that changes meanwhile may come as it was. Threads may ask at once.
class MeshShelf {
 public:
  /// From now on `mesh` stands for the file that recipes call `name`, as they write it.
  void put(const std::filesystem::path& name, Mesh mesh);

  /// The mesh that a recipe in `base_directory` calls `name`. Copies of it share its topology.
  /// Throws what `read_mesh` does.
  std::shared_ptr<const Mesh> mesh(const std::filesystem::path& base_directory,
                                   const std::filesystem::path& name) const;

 private:
  struct FileMesh {
    std::filesystem::path file;
    std::shared_ptr<const Mesh> mesh;
  };

  mutable std::mutex mutex_;
  std::map<std::filesystem::path, std::shared_ptr<const Mesh>> put_;
  mutable std::vector<FileMesh> read_;  ///< the one asked for last comes last
};

}  // namespace lapwing
