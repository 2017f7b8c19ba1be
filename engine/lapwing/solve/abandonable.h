#pragma once

#include <functional>
#include <vector>

namespace lapwing {

/// What `work` returns or throws, for work of a library that cannot be interrupted. It runs on a
/// thread of its own while this one asks whether to go on; once that is answered with no, throws
/// what `check_cancelled` does and leaves the thread to itself, which ends when the work is done.
/// So `work` must own all that it uses. Two threads may be left so; whoever comes then waits until
/// one of them has ended, or is cancelled. Without a ProgressScope it runs here.
std::vector<int> run_abandonable(std::function<std::vector<int>()> work);

}  // namespace lapwing
