#pragma once

#include "lapwing/recipe/json_node.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// The coat step that `node` describes. Throws InputError with the place.
CoatStep read_coat(const JsonNode& node);

}  // namespace lapwing
