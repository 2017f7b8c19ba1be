#include "lapwing/step/mesh_shelf.h"

#include <algorithm>

#include "lapwing/io/mesh_file.h"

namespace lapwing {
namespace {

// A recipe names two or three; a run of many recipes may name thousands, which must not fill the
// memory.
constexpr std::size_t kKeptFiles = 8;

}  // namespace

void MeshShelf::put(const std::filesystem::path& name, Mesh mesh) {
  const std::lock_guard lock(mutex_);
  put_[name] = std::make_shared<const Mesh>(std::move(mesh));
}

std::shared_ptr<const Mesh> MeshShelf::mesh(const std::filesystem::path& base_directory,
                                            const std::filesystem::path& name) const {
  // Held while a file is read, so that threads that ask for the same one wait for it.
  const std::lock_guard lock(mutex_);
  if (const auto at = put_.find(name); at != put_.end()) return at->second;
  const std::filesystem::path file = base_directory / name;
  const auto at = std::find_if(read_.begin(), read_.end(),
                               [&](const FileMesh& kept) { return kept.file == file; });
  if (at != read_.end()) {
    std::rotate(at, at + 1, read_.end());
    return read_.back().mesh;
  }
  auto mesh = std::make_shared<const Mesh>(read_mesh(file));
  if (read_.size() == kKeptFiles) read_.erase(read_.begin());
  read_.push_back({file, mesh});
  return mesh;
}

}  // namespace lapwing
