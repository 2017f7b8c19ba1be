#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "report/report.h"

namespace lapwing::bench {

/// What a process told, and how it ended.
struct Told {
  std::string text;
  std::string
      failure;  ///< what was thrown, or the signal or the limit that ended it; empty if well
};

/// Does `work` in a process of its own, a copy of this one, for at most `most_seconds` (0: as long
/// as it takes), and returns what it told by then, which must hold no NUL. This process must not
/// have opened a device or worked on several threads. Throws Error when there is no process to be
/// had.
Told told_apart(const std::function<void(const std::function<void(std::string_view)>& tell)>& work,
                double most_seconds = 0.0);

/// What `work` returns, made by a process of its own, a copy of this one: memory that it leaves in
/// pieces, caches and threads do not tell on what is measured next, and when it dies the others'
/// results are there. What goes to standard error there comes from here. This process must not have
/// opened a device. Throws Error with the words of what `work` threw, or that say how the process
/// ended.
Report made_apart(const std::function<Report()>& work);

}  // namespace lapwing::bench
