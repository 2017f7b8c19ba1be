#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "editing/part_shelf.h"
#include "window/ui_renderer.h"

namespace lapwing::viewer {

/// The pictures of a shelf's parts on the device.
class PartPictures {
 public:
  /// Before panels are laid out: those of `shelf` as it is now, on `context`, which must outlive
  /// them.
  void renew(const PartShelf& shelf, gpu::Context& context);
  /// Lets all go that is on the device.
  void release();

  /// Of the shelf's item `k`; null where there is none.
  const UiPicture* of(std::size_t k) const { return pictures_[k].get(); }

 private:
  std::vector<std::unique_ptr<UiPicture>> pictures_;
  std::uint64_t version_ = 0;  // of the shelf
};

}  // namespace lapwing::viewer
