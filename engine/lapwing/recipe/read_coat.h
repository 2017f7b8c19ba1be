#pragma once

#include "lapwing/recipe/json_node.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// The coat step that `node` describes. Throws InputError with the place.
CoatStep read_coat(const JsonNode& node);
MappedSampling read_sampling(const JsonNode& node);
Remeshing read_remeshing(const JsonNode& node);
Transition read_transition(const JsonNode& node);

}  // namespace lapwing
