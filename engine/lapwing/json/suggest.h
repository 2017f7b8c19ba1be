#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lapwing {

/// Returns the end of a message about a name that is not in `known`: `did you mean "roi"? Known
/// here: "op", "roi"`. If no known name is close, the question is omitted.
std::string suggest(std::string_view name, std::span<const std::string_view> known);

/// Returns the known name closest to `name`, or an empty string if no known name is close.
std::string_view nearest(std::string_view name, std::span<const std::string_view> known);

/// Returns the names in quotes, separated by commas.
std::string quoted_list(std::span<const std::string_view> names);

}  // namespace lapwing
