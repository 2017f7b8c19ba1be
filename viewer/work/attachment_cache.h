#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "lapwing/base/cancellation.h"
#include "state/carried_object.h"

namespace lapwing::viewer {

/// Moves carried objects with successive deforms of one surface. Their positions are bitwise
/// identical to those of a run of the recipe. Caches the attachment of each object to the rest
/// surface. All members are thread-safe.
class AttachmentCache {
 public:
  /// Returns the points of each object after the surface has moved from `rest` to `deformed`. The
  /// entry of an object that does not follow the surface is empty. Throws the errors of
  /// SurfaceContacts. Calls `progress` once per object, and throws Cancelled if it returns false.
  std::vector<std::optional<CarriedPoints>> carry(std::span<const CarriedObject> objects,
                                                  const std::shared_ptr<const Mesh>& rest,
                                                  const Deformed& deformed,
                                                  const Progress& progress);

  /// The largest number of attachment weights that are cached for one object; they use 128 MB. If
  /// an object needs more, its attachment is recomputed for each deform.
  static constexpr std::size_t kMostShares = 8'000'000;

 private:
  // The attachment of an object; empty if it has more than kMostShares weights.
  using Known = std::shared_ptr<const std::optional<CarryShares>>;

  std::shared_ptr<const SurfaceContacts> with(const std::shared_ptr<const Mesh>& rest);
  Known of(const std::shared_ptr<const AttachmentFile>& file, const SurfaceContacts& surface);

  std::mutex mutex_;  // also locked during a computation, so that no attachment is computed twice
  std::shared_ptr<const Mesh> rest_;
  std::shared_ptr<const SurfaceContacts> surface_;
  std::map<std::weak_ptr<const AttachmentFile>, Known, std::owner_less<>> known_;
};

/// Returns the files of `objects` with the points in `carried`. If an entry is empty, its points
/// stay at rest.
CarriedFiles files_of(std::span<const CarriedObject> objects,
                      std::vector<std::optional<CarriedPoints>> carried);

}  // namespace lapwing::viewer
