#pragma once

#include "lapwing/recipe/json_node.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// The transplant step that `node` describes. Throws InputError with the place.
TransplantStep read_transplant(const JsonNode& node);

}  // namespace lapwing
