#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "report/report.h"

namespace lapwing::bench {

/// A JSON value that keeps the order of its keys, so that reports can be compared line by line.
using Json = nlohmann::ordered_json;

/// Writes the report, with all runs, as JSON of format "lapwing-bench 1". Keys have a fixed order
/// and each measurement takes one line, so that two reports can be compared line by line. Measured
/// numbers have six significant digits, more than any clock measures.
std::string to_json(const Report& report);

/// Parses a report that to_json wrote. If the text is not a report, throws an InputError that gives
/// `name` as the file name.
Report parse_report(std::string_view json, const std::string& name);

/// Reads a report from a file. Also throws IoError if the file cannot be read.
Report read_report(const std::filesystem::path& path);

/// Returns the object as text. Each member of the object, and each element of a list, is on a
/// separate line. File names can contain invalid UTF-8, which is replaced.
std::string json_by_lines(const Json& object);

/// Parses a JSON object. If its format is not `format`, throws an InputError that gives `name` as
/// the file name.
Json parse_format(std::string_view json, const std::string& format, const std::string& name);

/// Throws an InputError with the message that the file `name` cannot be read, and the reason.
[[noreturn]] void fail_to_read(const std::string& name, const std::string& why);

/// Calls `read`. If the JSON library throws an error about a missing value or a wrong type, throws
/// an InputError with the file name instead.
template <class Read>
auto reading_json(const std::string& name, const Read& read) {
  try {
    return read();
  } catch (const nlohmann::json::exception& error) {
    fail_to_read(name, error.what());
  }
}

}  // namespace lapwing::bench
