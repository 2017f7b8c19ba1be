#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "lapwing/base/cancellation.h"
#include "state/carried_object.h"

namespace lapwing::viewer {

/// Carries objects along with successive deforms of a surface, with the same bits as a run of the
/// recipe. Attaches each object to the rest surface only once. Threads may share a cache.
class AttachmentCache {
 public:
  /// Returns where `objects`, at rest with the surface of `rest`, are after it moved to `deformed`,
  /// in their order; nothing for one that stays. Throws what SurfaceContacts throws, and Cancelled
  /// if `progress`, asked once per object, says so.
  std::vector<std::optional<CarriedPoints>> carry(std::span<const CarriedObject> objects,
                                                  const std::shared_ptr<const Mesh>& rest,
                                                  const Deformed& deformed,
                                                  const Progress& progress);

  /// The cache keeps at most this many attachment shares per object, which are 128 MB. An object
  /// that needs more is attached again for each deform.
  static constexpr std::size_t kMostShares = 8'000'000;

 private:
  // Empty if it is too much to keep.
  using Known = std::shared_ptr<const std::optional<CarryShares>>;

  std::shared_ptr<const SurfaceContacts> with(const std::shared_ptr<const Mesh>& rest);
  Known of(const std::shared_ptr<const AttachmentFile>& file, const SurfaceContacts& surface);

  std::mutex mutex_;  // the others wait for what one thread finds
  std::shared_ptr<const Mesh> rest_;
  std::shared_ptr<const SurfaceContacts> surface_;
  std::map<std::weak_ptr<const AttachmentFile>, Known, std::owner_less<>> known_;
};

/// Returns `objects` as files, moved to `carried`.
CarriedFiles files_of(std::span<const CarriedObject> objects,
                      std::vector<std::optional<CarriedPoints>> carried);

}  // namespace lapwing::viewer
