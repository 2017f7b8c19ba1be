#include "ui/part_pictures.h"

namespace lapwing::viewer {

void PartPictures::renew(const PartShelf& shelf, gpu::Context& context) {
  if (version_ == shelf.version()) return;
  version_ = shelf.version();
  pictures_.clear();
  for (const PartShelf::Item& item : shelf.items()) {
    pictures_.push_back(item.picture ? std::make_unique<UiPicture>(context, *item.picture)
                                     : nullptr);
  }
}

void PartPictures::release() {
  pictures_.clear();
  version_ = 0;
}

}  // namespace lapwing::viewer
