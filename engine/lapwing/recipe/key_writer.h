#pragma once

#include "lapwing/recipe/write_value.h"

namespace lapwing {

/// Returns the step as JSON, in the format of recipes.
Json json_of(const Step& step);

}  // namespace lapwing
