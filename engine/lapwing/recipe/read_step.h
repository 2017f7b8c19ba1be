#pragma once

#include "lapwing/recipe/json_node.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// The step, handle or move that `node` describes. Throws InputError with the place.
Step read_step(const JsonNode& node);
MovedHandle read_handle(const JsonNode& node);
Move read_move(const JsonNode& node);
LaplacianWeights read_weights(const JsonNode& node);

}  // namespace lapwing
