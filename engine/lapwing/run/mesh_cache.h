#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The meshes that recipes name. A mesh that was added with `put` comes from memory, any other mesh
/// from its file. Meshes of files are cached while they are in use or among the last few that were
/// requested. The cache does not detect changes of files. Thread-safe.
class MeshCache {
 public:
  /// Adds `mesh`, which replaces the file that recipes call `name`.
  void put(const std::filesystem::path& name, Mesh mesh);

  /// Returns the mesh that a recipe in `base_directory` calls `name`. Copies of it share its
  /// topology. Throws as `read_mesh` does.
  std::shared_ptr<const Mesh> mesh(const std::filesystem::path& base_directory,
                                   const std::filesystem::path& name) const;

 private:
  std::shared_ptr<const Mesh> kept(const std::filesystem::path& file) const;

  mutable std::mutex mutex_;
  std::map<std::filesystem::path, std::shared_ptr<const Mesh>> put_;
  mutable std::map<std::filesystem::path, std::weak_ptr<const Mesh>> read_;
  mutable std::vector<std::shared_ptr<const Mesh>> recent_;  ///< in the order of the last request
};

}  // namespace lapwing
