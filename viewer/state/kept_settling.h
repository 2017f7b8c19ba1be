#pragma once

#include "state/app_state.h"

namespace lapwing::viewer {

/// Settling that is switched off and on again goes by the options that it had.
class KeptSettling {
 public:
  /// What a person means who changed `before` to `after` with the switch or beside it.
  EditParameters meant(const EditParameters& before, EditParameters after) {
    if (before.settle) options_ = *before.settle;
    if (!before.settle && after.settle) after.settle = options_;
    return after;
  }

 private:
  SettleOptions options_;
};

}  // namespace lapwing::viewer
