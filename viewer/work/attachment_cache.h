#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "lapwing/base/cancellation.h"
#include "state/carried_object.h"

namespace lapwing::viewer {

/// Moves carried objects with successive deforms of one surface. The positions are bitwise
/// identical to those of a run of the recipe. Caches the attachment of each object to the rest
/// surface. All members are thread-safe.
class AttachmentCache {
 public:
  /// Returns `objects`, in their order, after the surface of `rest` has moved to `deformed`. The
  /// entry of an object that does not move is empty. Throws what SurfaceContacts throws. Calls
  /// `progress` once per object, and throws Cancelled if `progress` cancels.
  std::vector<std::optional<CarriedPoints>> carry(std::span<const CarriedObject> objects,
                                                  const std::shared_ptr<const Mesh>& rest,
                                                  const Deformed& deformed,
                                                  const Progress& progress);

  /// Limits the number of attachment weights that are cached per object. This many weights take
  /// 128 MB. If an object needs more, its attachment is recomputed for each deform.
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
