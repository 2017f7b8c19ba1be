#include "lapwing/recipe/key_visitor.h"

#include <array>
#include <charconv>

namespace lapwing {

std::string digits(double number) {
  // Large enough for the smallest double without exponent.
  std::array<char, 512> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  return {text.data(), end.ptr};
}

bool Range::contains(double number) const {
  return (takes_least ? number >= least : number > least) && number <= most;
}

std::string Range::words(bool whole) const {
  const bool has_most = most < std::numeric_limits<double>::infinity();
  std::string text = whole ? "a whole number" : "a number";
  if (has_most && takes_least) {
    text += " from " + digits(least) + " to " + digits(most);
  } else if (!takes_least) {
    text += " above " + digits(least) + (has_most ? " and at most " + digits(most) : "");
  } else if (least == 0.0) {
    text = whole ? "a whole number from 0" : "0 or more";
  }
  return reason.empty() ? text : text + " (" + std::string(reason) + ")";
}

}  // namespace lapwing
