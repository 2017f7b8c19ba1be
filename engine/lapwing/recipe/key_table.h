#pragma once

#include <string>

#include "lapwing/step/step.h"

namespace lapwing {

/// The keys of an operation as a table in Markdown, a line each: name (`settle.tolerance` is a key
/// of the object `settle`), value, default, and what it is.
std::string key_table(const Operation& operation);

}  // namespace lapwing
