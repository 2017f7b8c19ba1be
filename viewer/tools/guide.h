#pragma once

#include <array>
#include <cstddef>

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// The steps of a task, for whoever does not know them yet: of a deform region, handle and drag.
struct Guide {
  struct Step {
    const char* name = "";
    bool is_done = false;
  };
  std::array<Step, 4> steps{};
  std::size_t count = 3;    ///< of them
  std::size_t current = 0;  ///< of the steps: what a hand would do now
  const char* what = "";    ///< to do for it, in a sentence
};

/// What to do next, with `part` being chosen by `tool`, or a handle moved if it `moves` them.
Guide guide_of(const AppState& state, const Part& part, const SceneTool& tool, bool moves);

}  // namespace lapwing::viewer
