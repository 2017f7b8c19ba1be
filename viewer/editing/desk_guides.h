#pragma once

#include "editing/detail_transfer_tool.h"
#include "editing/transplant_desk.h"
#include "tools/guide.h"

namespace lapwing::viewer {

/// Returns the guide for what is open: a coat, mix or transplant, or else the deform.
Guide guide_of(const DetailTransferTool& layers, const TransplantDesk& transplant,
               const Editor& editor);

}  // namespace lapwing::viewer
