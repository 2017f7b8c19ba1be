#pragma once

#include <cstddef>
#include <string>

namespace lapwing::bench {

/// How many colours there are for lines and bars; beyond, they are taken round.
inline constexpr std::size_t kColors = 10;

/// Classes of the shapes of plots. Colours are those of Paul Tol's "muted" scheme, which people who
/// are blind to some can tell apart, darkened where a line of them would be lost on white.
std::string line_class(std::size_t color);    ///< a line of a colour
std::string dashed_class(std::size_t color);  ///< a peer's
std::string marker_class(std::size_t color);  ///< filled
std::string bar_class(std::size_t color);     ///< filled, with a gap to its neighbour
std::string on_bar_class(std::size_t color);  ///< text that can be read on such a bar

/// CSS of these classes, and of "ink", "quiet" and "heading" (text), "grid", "axis", "mark" and
/// "error" (lines), "paper" (what lies behind). On white.
std::string light_theme();
/// The same on black, to stand behind the light one: only colours differ.
std::string dark_theme();

}  // namespace lapwing::bench
