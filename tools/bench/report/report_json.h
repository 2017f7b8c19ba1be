#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "report/report.h"

namespace lapwing::bench {

/// Writes the report, with all runs, as JSON of format "lapwing-bench 1". Keys have a fixed order
/// and each measurement takes one line, so that two reports can be compared line by line. Measured
/// numbers have six significant digits, more than any clock measures.
std::string to_json(const Report& report);

/// Reads what to_json wrote. Throws IoError if the file cannot be read. Throws InputError, which
/// names the file and the place in it, if it is not JSON, has another format, or lacks a value or
/// has one of the wrong type.
Report read_report(const std::filesystem::path& path);

/// The same for text in memory; errors call it `name`.
Report parse_report(std::string_view json, const std::string& name);

}  // namespace lapwing::bench
