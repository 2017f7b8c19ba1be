#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace lapwing {

/// Largest size of a message in bytes: 24 lines of 80 columns.
inline constexpr std::size_t kLongestMessage = 80 * 24;

/// Returns `text` as one line for any terminal, log or JSON document. Bytes that are not UTF-8, and
/// characters that a terminal or parser could interpret (control characters, escapes, line ends,
/// direction marks), are replaced by codes such as "\x1B" or "\u202E". If the text exceeds
/// `longest` bytes, its middle is replaced by " ... ", because a message begins with the location
/// and ends with the next step. Use it for all text from other programs, file names and file
/// contents.
std::string printable(std::string_view text, std::size_t longest = kLongestMessage);

/// Returns whether `text` is valid UTF-8.
bool is_utf8(std::string_view text);

/// Returns names for a message, such as "'Left', 'Right' and 'Top'". Lists at most five.
std::string quoted_list(std::span<const std::string> names);

/// Returns `number` with thousands separators, such as "14,290".
inline std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

}  // namespace lapwing
