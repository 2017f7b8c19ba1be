#pragma once

#include "lapwing/json/json_node.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// The step that `node` says. Throws InputError with the JSON pointer of what does not fit.
Step read_step(const JsonNode& node);

}  // namespace lapwing
