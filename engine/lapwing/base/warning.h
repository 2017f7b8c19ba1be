#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lapwing {

/// A change of a coat, mix or transplant that avoids a warning.
enum class Advice {
  none,
  set_transition_width,  ///< set it to Warning::value
  set_scale,             ///< set it to Warning::value
  negate_amplitude,
  refine_target,
  enlarge_hole,
};

/// A message to the user about a result.
struct Warning {
  std::string text;
  Advice advice = Advice::none;
  double value = 0.0;
  std::optional<std::size_t> source =
      {};  ///< the source that the advice concerns; if not set, all sources
};

inline std::vector<std::string> texts_of(std::span<const Warning> warnings) {
  std::vector<std::string> texts;
  for (const Warning& warning : warnings) texts.push_back(warning.text);
  return texts;
}

}  // namespace lapwing
