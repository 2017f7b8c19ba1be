#include "lapwing/json/suggest.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace lapwing {
namespace {

// Returns the Levenshtein distance: the number of insertions, deletions and substitutions that turn
// a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string quoted_list(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) {
    if (!text.empty()) text += ", ";
    text.append("\"").append(name).append("\"");
  }
  return text;
}

std::string_view nearest(std::string_view name, std::span<const std::string_view> known) {
  // If more than half of the letters differ, the name is probably not a typo.
  std::size_t least = std::max<std::size_t>(name.size() / 2, 1) + 1;
  std::string_view best;
  for (const std::string_view candidate : known) {
    // A prefix of a known name counts as one wrong letter.
    const bool is_start = !name.empty() && candidate.starts_with(name);
    const std::size_t distance = is_start ? 1 : edit_distance(name, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string suggest(std::string_view name, std::span<const std::string_view> known) {
  std::string text;
  const std::string_view meant = nearest(name, known);
  if (!meant.empty()) text.append("did you mean \"").append(meant).append("\"? ");
  return text + "Known here: " + quoted_list(known);
}

}  // namespace lapwing
