#pragma once

#include "lapwing/base/errors.h"

namespace lapwing::viewer {

/// No window can be opened: there is no display, or it refuses.
class WindowError : public Error {
 public:
  using Error::Error;
};

}  // namespace lapwing::viewer
