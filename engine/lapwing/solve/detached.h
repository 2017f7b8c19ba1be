#pragma once

#include <functional>
#include <vector>

namespace lapwing {

/// Returns or throws what `work` does. `work` is a library call that cannot be interrupted. It runs
/// on another thread while this one polls `check_cancelled`. If that throws, so does this call, and
/// the thread is abandoned: it ends when `work` is done. So `work` must own everything it uses. At
/// most two threads are abandoned at a time; further calls wait until one of them ends. Without a
/// ProgressScope, `work` runs on the calling thread.
std::vector<int> run_detached(std::function<std::vector<int>()> work);

}  // namespace lapwing
