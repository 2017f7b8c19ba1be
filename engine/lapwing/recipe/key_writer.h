#pragma once

#include "lapwing/recipe/write_value.h"

namespace lapwing {

/// The step as JSON, as recipes have it.
Json json_of(const Step& step);

}  // namespace lapwing
