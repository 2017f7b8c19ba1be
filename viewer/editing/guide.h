#pragma once

#include <array>
#include <cstddef>

#include "editing/detail_transfer_tool.h"
#include "editing/transplant_tool.h"
#include "editing/wrap_tool.h"

namespace lapwing::viewer {

/// The steps of a task, for new users. A deformation has region, handle and drag.
struct Guide {
  struct Step {
    const char* name = "";
    bool is_done = false;
  };
  std::array<Step, 4> steps{};
  std::size_t count = 3;    ///< number of steps in use
  std::size_t current = 0;  ///< index of the step to do now; `count` for none
  const char* what = "";    ///< what to do now, in a sentence
};

/// Returns what to do next while `tool` chooses `part`, or moves a handle if `moves`.
Guide guide_of(const AppState& state, const Part& part, const SceneTool& tool, bool moves);

/// Returns the guide for the open coat, mix, transplant or wrap. If none is open, returns the guide
/// for the deform.
Guide guide_of(const DetailTransferTool& layers, const TransplantTool& transplant,
               const WrapTool& wrap, const Editor& editor);

}  // namespace lapwing::viewer
