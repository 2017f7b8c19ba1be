#include "work/attachment_cache.h"

#include <utility>

namespace lapwing::viewer {

std::shared_ptr<const SurfaceContacts> AttachmentCache::with(
    const std::shared_ptr<const Mesh>& rest) {
  const std::lock_guard lock(mutex_);
  if (rest_ != rest) {
    known_.clear();
    surface_ = std::make_shared<const SurfaceContacts>(rest->positions, rest->topology());
    rest_ = rest;
  }
  return surface_;
}

AttachmentCache::Known AttachmentCache::of(const std::shared_ptr<const AttachmentFile>& file,
                                           const SurfaceContacts& surface) {
  const auto find = [&] {
    return std::make_shared<const std::optional<CarryShares>>(
        surface.find_all(file->positions(), kMostShares));
  };
  const std::lock_guard lock(mutex_);
  // If another thread has changed the surface meanwhile, do not use the cache.
  if (&surface != surface_.get()) return find();
  const auto at = known_.find(file);
  if (at != known_.end()) return at->second;
  std::erase_if(known_, [](const auto& known) { return known.first.expired(); });
  return known_.emplace(file, find()).first->second;
}

std::vector<std::optional<CarriedPoints>> AttachmentCache::carry(
    std::span<const CarriedObject> objects, const std::shared_ptr<const Mesh>& rest,
    const Deformed& deformed, const Progress& progress) {
  const auto surface = with(rest);
  const AttachmentDeformer carrier(surface, deformed);
  std::vector<std::optional<CarriedPoints>> carried;
  for (const CarriedObject& object : objects) {
    report_progress(progress, "carry", 0.0);
    if (!object.follows) {
      carried.emplace_back();
      continue;
    }
    const Positions& points = object.rest->positions();
    const Known shares = of(object.rest, *surface);
    carried.emplace_back(*shares ? carrier.carry(points, **shares) : carrier.carry(points));
  }
  return carried;
}

CarriedFiles files_of(std::span<const CarriedObject> objects,
                      std::vector<std::optional<CarriedPoints>> carried) {
  CarriedFiles files;
  for (std::size_t k = 0; k < objects.size(); ++k) {
    files.push_back(objects[k].rest);
    if (!carried[k]) continue;
    auto moved = std::make_shared<AttachmentFile>(*objects[k].rest);
    moved->move(*std::move(carried[k]));
    files.back() = std::move(moved);
  }
  return files;
}

}  // namespace lapwing::viewer
