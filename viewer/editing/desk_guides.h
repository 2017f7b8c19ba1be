#pragma once

#include "editing/layer_desk.h"
#include "editing/transplant_desk.h"
#include "tools/guide.h"

namespace lapwing::viewer {

/// Returns the guide for what is open: a coat, mix or transplant, or else the deform.
Guide guide_of(const LayerDesk& layers, const TransplantDesk& transplant, const Editor& editor);

}  // namespace lapwing::viewer
