#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "lapwing/base/progress.h"
#include "state/carried_object.h"

namespace lapwing::viewer {

/// Carries objects along with one deform of a surface after the other, by the SurfaceCarrier that a
/// run uses, to the same bits. What they follow of the surface at rest is found once per object and
/// kept: after that a deform costs a fit of a rotation per vertex that may move and a mean per
/// point. Threads may share one.
class CarryContacts {
 public:
  /// Where `objects`, at rest with the surface of `rest`, are once that went to `deformed`, in
  /// their order; nothing for one that stays. Throws what SurfaceContacts does, Cancelled when
  /// `progress`, asked once per object, says so.
  std::vector<std::optional<CarriedPoints>> carry(std::span<const CarriedObject> objects,
                                                  const std::shared_ptr<const Mesh>& rest,
                                                  const Deformed& deformed,
                                                  const Progress& progress);

  /// Of an object, 128 MB. One whose points follow more, as a large one far from a fine surface
  /// does, is carried all the same, but what it follows is found anew each time.
  static constexpr std::size_t kMostShares = 8'000'000;

 private:
  // Nothing where it is too much to be kept.
  using Known = std::shared_ptr<const std::optional<CarryShares>>;

  std::shared_ptr<const SurfaceContacts> with(const std::shared_ptr<const Mesh>& rest);
  Known of(const std::shared_ptr<const CarriedFile>& file, const SurfaceContacts& surface);

  std::mutex mutex_;  // what one thread finds the others wait for
  std::shared_ptr<const Mesh> rest_;
  std::shared_ptr<const SurfaceContacts> surface_;
  std::map<std::weak_ptr<const CarriedFile>, Known, std::owner_less<>> known_;
};

/// `objects` as files, where `carried` puts them.
CarriedFiles files_of(std::span<const CarriedObject> objects,
                      std::vector<std::optional<CarriedPoints>> carried);

}  // namespace lapwing::viewer
