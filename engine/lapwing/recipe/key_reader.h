#pragma once

#include "lapwing/json/json_node.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// Reads a step. Throws InputError with the JSON pointer of the first mistake.
Step read_step(const JsonNode& node);

}  // namespace lapwing
