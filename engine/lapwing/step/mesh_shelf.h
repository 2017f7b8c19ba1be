#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Where the meshes that recipes name come from: from memory if one was put there under its name,
/// else from a file, which is read once and kept while someone has it or it is among the last few
/// asked for. A file that changes meanwhile may come as it was. Threads may ask at once.
class MeshShelf {
 public:
  /// From now on `mesh` stands for the file that recipes call `name`, as they write it.
  void put(const std::filesystem::path& name, Mesh mesh);

  /// The mesh that a recipe in `base_directory` calls `name`. Copies of it share its topology.
  /// Throws what `read_mesh` does.
  std::shared_ptr<const Mesh> mesh(const std::filesystem::path& base_directory,
                                   const std::filesystem::path& name) const;

 private:
  std::shared_ptr<const Mesh> kept(const std::filesystem::path& file) const;

  mutable std::mutex mutex_;
  std::map<std::filesystem::path, std::shared_ptr<const Mesh>> put_;
  mutable std::map<std::filesystem::path, std::weak_ptr<const Mesh>> read_;
  mutable std::vector<std::shared_ptr<const Mesh>> recent_;  ///< the last one asked for comes last
};

}  // namespace lapwing
