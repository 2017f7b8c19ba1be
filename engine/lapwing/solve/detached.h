#pragma once

#include <functional>
#include <vector>

namespace lapwing {

/// Calls `work`, which contains a library call that cannot be interrupted. Returns its result or
/// throws its exception. `work` runs on another thread while the calling thread polls
/// `check_cancelled`. If the poll throws, this function rethrows and abandons the other thread,
/// which runs until `work` ends. `work` must therefore own everything that it uses. If two threads
/// are abandoned, further calls wait until one of them ends. Without a ProgressScope, `work` runs
/// on the calling thread.
std::vector<int> run_detached(std::function<std::vector<int>()> work);

}  // namespace lapwing
