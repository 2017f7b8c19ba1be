#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Something that takes bytes of any kind. It throws Violation where what must hold does not, and
/// whatever else leaves it is a finding, too: errors that a user could be told are caught inside.
struct Target {
  std::string_view name;
  std::string_view tries;  ///< for people, what it does with the bytes
  void (*run)(Bytes bytes);
  std::vector<std::string> (*seeds)();  ///< inputs to begin with
  std::string_view dictionary;          ///< file in dictionaries/; empty for none
  /// Runs of the mutations in an ordinary test, which is to take a second or so.
  int usual_runs;
};

/// All of them.
std::span<const Target> targets();
/// Throws std::invalid_argument for a name that is none.
const Target& target_named(std::string_view name);

/// What must hold does not.
struct Violation {
  std::string what;
};
void require(bool holds, std::string_view what);

/// A file of those bytes in memory, called so, until the next one of that name is asked for.
std::filesystem::path file_of(Bytes bytes, std::string_view name);
std::filesystem::path file_of(std::string_view text, std::string_view name);
std::string_view text_of(Bytes bytes);

std::span<const Target> file_targets();
std::span<const Target> recipe_targets();
std::span<const Target> operation_targets();

}  // namespace lapwing::fuzz
