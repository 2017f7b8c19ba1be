#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lapwing {

/// The end of a message about a name that is none of `known`: `did you mean "roi"? Known are "op",
/// "roi".` The question is left out when no known name is close.
std::string suggest(std::string_view name, std::span<const std::string_view> known);

/// The names in quotes, separated by commas.
std::string quoted_list(std::span<const std::string_view> names);

}  // namespace lapwing
