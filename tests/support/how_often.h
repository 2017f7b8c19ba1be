#pragma once

#include <cstdlib>

namespace lapwing::test {

/// How often a test does what more of finds more: the number in the environment under `variable`,
/// or else `usual`, which suits every run of the tests.
inline int how_often(const char* variable, int usual) {
  const char* const wanted = std::getenv(variable);
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

}  // namespace lapwing::test
