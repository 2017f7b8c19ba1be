#include "lapwing/run/mesh_cache.h"

#include <algorithm>

#include "lapwing/io/mesh_file.h"

namespace lapwing {
namespace {

// Number of cached meshes. A recipe names two or three files, but a batch may name thousands.
constexpr std::size_t kKeptFiles = 8;

}  // namespace

void MeshCache::put(const std::filesystem::path& name, Mesh mesh) {
  const std::lock_guard lock(mutex_);
  put_[name] = std::make_shared<const Mesh>(std::move(mesh));
}

// Returns the cached mesh, or null if the file must be read.
std::shared_ptr<const Mesh> MeshCache::kept(const std::filesystem::path& file) const {
  const auto at = read_.find(file);
  std::shared_ptr<const Mesh> mesh = at != read_.end() ? at->second.lock() : nullptr;
  if (mesh == nullptr) return nullptr;
  std::erase(recent_, mesh);
  if (recent_.size() == kKeptFiles) recent_.erase(recent_.begin());
  recent_.push_back(mesh);
  return mesh;
}

std::shared_ptr<const Mesh> MeshCache::mesh(const std::filesystem::path& base_directory,
                                            const std::filesystem::path& name) const {
  const std::filesystem::path file = base_directory / name;
  {
    const std::lock_guard lock(mutex_);
    if (const auto at = put_.find(name); at != put_.end()) return at->second;
    if (auto mesh = kept(file)) return mesh;
  }
  // Read without the lock, so that threads that need other files do not wait.
  auto mesh = std::make_shared<const Mesh>(read_mesh(file));
  const std::lock_guard lock(mutex_);
  if (auto others = kept(file)) return others;
  std::erase_if(read_, [](const auto& entry) { return entry.second.expired(); });
  read_[file] = mesh;
  return kept(file);
}

}  // namespace lapwing
