#pragma once

#include "lapwing/json/json_node.h"
#include "lapwing/region/border_belt.h"

namespace lapwing {

/// Reads a region or belt. Throws InputError with the JSON pointer of the first mistake.
RegionSpec read_region(const JsonNode& node);
BeltSpec read_belt(const JsonNode& node);

}  // namespace lapwing
