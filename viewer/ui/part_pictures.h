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
  /// Updates the pictures to those of `shelf`, on `context`, which must outlive them. Call it
  /// before panels are laid out.
  void renew(const PartShelf& shelf, gpu::Context& context);
  /// Releases everything on the device.
  void release();

  /// Returns the picture of the shelf's item `k`; null if it has none.
  const UiPicture* of(std::size_t k) const { return pictures_[k].get(); }

 private:
  std::vector<std::unique_ptr<UiPicture>> pictures_;
  std::uint64_t version_ = 0;  // of the shelf
};

}  // namespace lapwing::viewer
