#pragma once

#include "lapwing/recipe/json_node.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// The mix step that `node` describes. Throws InputError with the place.
MixStep read_mix(const JsonNode& node);

}  // namespace lapwing
