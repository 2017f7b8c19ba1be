#pragma once

#include "lapwing/recipe/json_node.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// The coat step that `node` describes. Throws InputError with the place.
CoatStep read_coat(const JsonNode& node);
MappedSampling read_sampling(const JsonNode& node);
Remeshing read_remeshing(const JsonNode& node);
Transition read_transition(const JsonNode& node);

/// What coat and mix steps share. Of `node` a source's detail size, pairs, sampling, scale and
/// amplitude; `domain` is that of the step.
FileSource read_source_keys(const JsonNode& node, Domain domain);
/// Of a step how its target is treated: "smooth_target", "weights", "domain", "transition" and
/// "remesh".
CoatParameters read_coat_parameters(const JsonNode& node);
/// "smooth" or "linear".
Transition::Profile read_profile(const JsonNode& node);

}  // namespace lapwing
