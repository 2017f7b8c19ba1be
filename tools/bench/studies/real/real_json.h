#pragma once

#include <string>
#include <string_view>

#include "studies/real/real_run.h"

namespace lapwing::bench {

/// The report as JSON of format "lapwing-bench real 1", a run to a line, with the summary of its
/// runs, which is not read back. Numbers have six digits that count.
std::string to_json(const RealReport& report);

/// Reads what to_json wrote; `name` stands in errors for the file. Throws InputError that names the
/// place when it is no such report.
RealReport parse_real_report(std::string_view json, const std::string& name);

/// The same for one mesh, in one line.
std::string to_json_line(const RealMesh& mesh);
RealMesh parse_real_mesh(std::string_view json);

}  // namespace lapwing::bench
