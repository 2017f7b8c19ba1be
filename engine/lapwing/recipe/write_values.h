#pragma once

#include <nlohmann/json.hpp>

#include "lapwing/recipe/step.h"

namespace lapwing {

using Json = nlohmann::ordered_json;

// Writers of the compound values of recipes. The readers are in read_values.h.
Json json_of(const RegionSpec& spec);
Json json_of(const BeltSpec& belt);
Json json_of(const Move& move);
Json json_of(const std::vector<MovedHandle>& handles);
Json json_of(const TargetSpec& targets);
Json json_of(const LandmarkSpec& landmarks);
Json json_of(const std::vector<StiffnessSpec>& stiffness);
Json json_of(const MirrorSpec& mirror);
Json json_of(const std::vector<CarrySpec>& carry);
Json json_of(const MixWeight& weight);
Json json_of(const PartPlace& place);

}  // namespace lapwing
