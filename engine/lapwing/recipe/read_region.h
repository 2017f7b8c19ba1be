#pragma once

#include "lapwing/json/json_node.h"
#include "lapwing/region/border_belt.h"

namespace lapwing {

/// The region or belt that `node` describes. Throws InputError with the place.
RegionSpec read_region(const JsonNode& node);
BeltSpec read_belt(const JsonNode& node);

}  // namespace lapwing
