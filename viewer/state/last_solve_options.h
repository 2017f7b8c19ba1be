#pragma once

#include "state/app_state.h"

namespace lapwing::viewer {

/// Remembers the options of settling while it is switched off.
class LastSolveOptions {
 public:
  /// Returns what a user means by changing `before` to `after`: settling that is switched on again
  /// keeps its options.
  EditParameters meant(const EditParameters& before, EditParameters after) {
    if (before.settle) options_ = *before.settle;
    if (!before.settle && after.settle) after.settle = options_;
    return after;
  }

 private:
  SettleOptions options_;
};

}  // namespace lapwing::viewer
