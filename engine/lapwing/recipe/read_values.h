#pragma once

#include "lapwing/json/json_node.h"
#include "lapwing/recipe/key_visitor.h"
#include "lapwing/recipe/step.h"

namespace lapwing {

// Readers of compound values. Each throws InputError with the JSON pointer of the first mistake.
RegionSpec read_region(const JsonNode& node);
BeltSpec read_belt(const JsonNode& node);
Move read_move(const JsonNode& node);
MovedHandle read_handle(const JsonNode& node, HandleForm form);
TargetSpec read_targets(const JsonNode& node);
LandmarkSpec read_landmarks(const JsonNode& node);
StiffnessSpec read_stiffness(const JsonNode& node);
MirrorSpec read_mirror(const JsonNode& node);
CarrySpec read_carry(const JsonNode& node);
std::vector<VertexPair> read_pairs(const JsonNode& node);
MixWeight read_weight(const JsonNode& node);
PartPlace read_place(const JsonNode& node);

}  // namespace lapwing
