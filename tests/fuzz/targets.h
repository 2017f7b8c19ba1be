#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// A fuzz target. `run` accepts any bytes and throws Violation if a property does not hold. Any
/// other exception is also a bug, because `run` catches the errors that a user may see.
struct Target {
  std::string_view name;
  std::string_view tries;  ///< what `run` does with the bytes
  void (*run)(Bytes bytes);
  std::vector<std::string> (*seeds)();  ///< initial inputs
  std::string_view dictionary;          ///< file in dictionaries/; empty for none
  /// The number of mutations in an ordinary test run, chosen so that they take about a second.
  int usual_runs;
};

std::span<const Target> targets();
/// Returns the target called `name`. Throws std::invalid_argument if it does not exist.
const Target& target_named(std::string_view name);

/// Describes a property that does not hold.
struct Violation {
  std::string what;
};
void require(bool holds, std::string_view what);

/// Writes `bytes` to an in-memory file called `name`, replacing the previous file, and returns its
/// path.
std::filesystem::path file_of(Bytes bytes, std::string_view name);
std::filesystem::path file_of(std::string_view text, std::string_view name);
std::string_view text_of(Bytes bytes);

std::span<const Target> file_targets();
std::span<const Target> recipe_targets();
std::span<const Target> operation_targets();

}  // namespace lapwing::fuzz
