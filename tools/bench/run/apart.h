#pragma once

#include <functional>

#include "report/report.h"

namespace lapwing::bench {

/// What `work` returns, made by a process of its own, a copy of this one: memory that it leaves in
/// pieces, caches and threads do not tell on what is measured next, and when it dies the others'
/// results are there. What goes to standard error there comes from here. This process must not have
/// opened a device. Throws Error with the words of what `work` threw, or that say how the process
/// ended.
Report made_apart(const std::function<Report()>& work);

}  // namespace lapwing::bench
