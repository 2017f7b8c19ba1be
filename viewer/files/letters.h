#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace lapwing::viewer {

/// Converts ASCII letters; other bytes stay.
inline char lower_case(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

inline std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) { return lower_case(c); });
  return text;
}

}  // namespace lapwing::viewer
