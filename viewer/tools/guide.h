#pragma once

#include <array>
#include <cstddef>

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// The three steps of an edit, for whoever does not know them yet.
struct Guide {
  struct Step {
    const char* name;
    bool is_done;
  };
  std::array<Step, 3> steps;
  std::size_t current = 0;  ///< of the steps: what a hand would do now
  const char* what = "";    ///< to do for it, in a sentence
};

/// What to do next, with `part` being chosen by `tool`, or a handle moved if it `moves` them.
Guide guide_of(const AppState& state, const Part& part, const SceneTool& tool, bool moves);

}  // namespace lapwing::viewer
