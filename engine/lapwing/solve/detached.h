#pragma once

#include <functional>
#include <vector>

namespace lapwing {

/// Calls `work`, which wraps a library call that cannot be interrupted, and returns its result or
/// throws its exception. It runs on another thread while this one polls `check_cancelled`. If the
/// poll throws, this function throws too and abandons the thread until `work` ends. Therefore
/// `work` must own everything it uses. At most two threads are abandoned at a time; further calls
/// wait. Without a ProgressScope, `work` runs on the calling thread.
std::vector<int> run_detached(std::function<std::vector<int>()> work);

}  // namespace lapwing
