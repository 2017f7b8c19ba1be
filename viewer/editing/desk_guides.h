#pragma once

#include "editing/layer_desk.h"
#include "editing/transplant_desk.h"
#include "tools/guide.h"

namespace lapwing::viewer {

/// What comes next of what is open: of a coat, a mix or a transplant, or else of the deform.
Guide guide_of(const LayerDesk& layers, const TransplantDesk& transplant, const Editor& editor);

}  // namespace lapwing::viewer
