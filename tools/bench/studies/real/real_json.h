#pragma once

#include <string>
#include <string_view>

#include "studies/real/real_run.h"

namespace lapwing::bench {

/// Writes the report as JSON of format "lapwing-bench real 2", one run per line, with the summary,
/// which is not read back. Numbers have six significant digits.
std::string to_json(const RealReport& report);

/// Reads what to_json wrote; errors call the file `name`. Throws InputError, which names the place,
/// if it is not such a report.
RealReport parse_real_report(std::string_view json, const std::string& name);

/// The same for one mesh, in one line.
std::string to_json_line(const RealMesh& mesh);
RealMesh parse_real_mesh(std::string_view json);

}  // namespace lapwing::bench
