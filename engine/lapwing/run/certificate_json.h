#pragma once

#include <nlohmann/json.hpp>

#include "lapwing/deform/certificate.h"

namespace lapwing {

/// Returns the certificate in the format of reports. Numbers that are not finite become null.
nlohmann::ordered_json json_of(const Certificate& certificate);

}  // namespace lapwing
