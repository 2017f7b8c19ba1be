#pragma once

#include <cstddef>
#include <vector>

namespace lapwing {

/// What frames of a drag changed, each counted by half of the next: recent = recent / 2 + (to -
/// from), and to - from where `recent` is empty.
template <typename T>
void add_change(std::vector<T>& recent, const std::vector<T>& from, const std::vector<T>& to) {
  constexpr double kShareOfOlder = 0.5;
  const bool is_first = recent.empty();
  recent.resize(to.size());
  for (std::size_t k = 0; k < to.size(); ++k) {
    const T change = to[k] - from[k];
    recent[k] = is_first ? change : T(kShareOfOlder * recent[k] + change);
  }
}

}  // namespace lapwing
