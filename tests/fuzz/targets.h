#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// A function that accepts any bytes. It throws Violation if a property does not hold. Any other
/// exception is a finding, too, because the target catches the errors that a user may see.
struct Target {
  std::string_view name;
  std::string_view tries;  ///< what it does with the bytes
  void (*run)(Bytes bytes);
  std::vector<std::string> (*seeds)();  ///< initial inputs
  std::string_view dictionary;          ///< file in dictionaries/; empty for none
  /// Number of mutations in an ordinary test, which should take about a second.
  int usual_runs;
};

std::span<const Target> targets();
/// Throws std::invalid_argument if there is no such target.
const Target& target_named(std::string_view name);

/// Reports a property that does not hold.
struct Violation {
  std::string what;
};
void require(bool holds, std::string_view what);

/// Writes a file in memory with that name, and replaces the last one.
std::filesystem::path file_of(Bytes bytes, std::string_view name);
std::filesystem::path file_of(std::string_view text, std::string_view name);
std::string_view text_of(Bytes bytes);

std::span<const Target> file_targets();
std::span<const Target> recipe_targets();
std::span<const Target> operation_targets();

}  // namespace lapwing::fuzz
