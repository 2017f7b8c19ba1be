#pragma once

#include <nlohmann/json.hpp>

#include "lapwing/deform/certificate.h"
#include "lapwing/run/run_report.h"

namespace lapwing {

// Parts of a report as JSON. Numbers that are not finite become null.
nlohmann::ordered_json json_of(const Certificate& certificate);
nlohmann::ordered_json json_of(const WrapStepReport& wrap);

}  // namespace lapwing
