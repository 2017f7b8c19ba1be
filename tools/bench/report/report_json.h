#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "report/report.h"

namespace lapwing::bench {

/// The report as JSON of format "lapwing-bench 1": everything it holds, all runs too, keys always
/// in the same order and a measurement to a line, so that two reports can be laid beside each
/// other. Measured numbers are written with six digits that count, more than any clock is good for.
std::string to_json(const Report& report);

/// Reads what to_json wrote. Throws IoError when the file cannot be read, and InputError that names
/// the file and the place in it when it is no JSON, is of another format, or when something is
/// missing or of the wrong kind.
Report read_report(const std::filesystem::path& path);

/// The same for text that is there already; `name` stands in errors for the file.
Report parse_report(std::string_view json, const std::string& name);

}  // namespace lapwing::bench
