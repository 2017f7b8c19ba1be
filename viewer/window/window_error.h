#pragma once

#include "lapwing/base/errors.h"

namespace lapwing::viewer {

/// No window can be opened: no display, or one that refuses.
class WindowError : public Error {
 public:
  using Error::Error;
};

}  // namespace lapwing::viewer
