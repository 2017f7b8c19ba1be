#pragma once

#include <cstddef>
#include <string>

namespace lapwing {

/// Returns `number` with thousands separators, such as "14,290".
inline std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

}  // namespace lapwing
