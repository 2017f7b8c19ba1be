#pragma once

#include <imgui.h>
#include <optional>
#include <string>
#include <vector>

namespace lapwing::viewer::test {

/// One line of text as a frame draws it.
struct ShownText {
  std::string words;
  ImVec2 min;  ///< corners of what its letters cover, in ImGui's units
  ImVec2 max;
  bool is_cut = false;  ///< something hides the left or right end of a letter, or a whole one
  /// Of its colour to what was drawn below it, the worst of its letters; where that lets the scene
  /// shine through, the worst of a black and a white one (WCAG 2.1: from 1 to 21).
  double contrast = 21.0;

  ImVec2 middle() const { return {0.5F * (min.x + max.x), 0.5F * (min.y + max.y)}; }
};

/// The texts of a frame that was laid out by the current ImGui context, in the order in which they
/// are drawn, read from its triangles: what a person sees, whichever function drew it. Text that a
/// window above hides is left out.
std::vector<ShownText> read_screen(const ImDrawData& frame);

/// The last one that says `words` and nothing else.
std::optional<ShownText> find_text(const std::vector<ShownText>& texts, const std::string& words);

}  // namespace lapwing::viewer::test
