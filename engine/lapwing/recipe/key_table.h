#pragma once

#include <string>

#include "lapwing/step/step.h"

namespace lapwing {

/// Returns the keys of an operation as a Markdown table with name, value, default and help.
/// `settle.tolerance` names the key `tolerance` of the object `settle`.
std::string key_table(const Operation& operation);

}  // namespace lapwing
