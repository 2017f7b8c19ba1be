#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lapwing {

/// The most bytes of a message: what a terminal of 80 columns shows on 24 lines.
inline constexpr std::size_t kLongestMessage = 80 * 24;

/// `text` as one line that any terminal, log or JSON document can hold: what is not valid UTF-8,
/// and every character that a terminal or reader could take for more than a letter (controls,
/// escapes, ends of lines, marks that turn the direction of writing), stands there as "\x1B" or
/// "\u202E". What does not fit into `longest` bytes is left out in the middle, where " ... "
/// stands, since a message begins with its place and ends with the next step. Text of other
/// programs, names and contents of files are shown to people through this alone.
std::string printable(std::string_view text, std::size_t longest = kLongestMessage);

}  // namespace lapwing
