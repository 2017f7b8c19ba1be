#pragma once

#include <imgui.h>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include <Eigen/Core>

#include "lapwing/base/warning.h"
#include "navigation/keymap.h"
#include "state/message.h"

namespace lapwing::viewer {

/// Flags of a window in the layout: it stays where it is and behind what opens over it.
inline constexpr ImGuiWindowFlags kFixed =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;
/// Flags of a window that does not scroll.
inline constexpr ImGuiWindowFlags kWithoutScrolling =
    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
/// Flags of a dialog whose size adapts to its contents.
inline constexpr ImGuiWindowFlags kDialog = ImGuiWindowFlags_AlwaysAutoResize |
                                            ImGuiWindowFlags_NoCollapse |
                                            ImGuiWindowFlags_NoSavedSettings;

/// The colours of the ROI, handles and belt must be those in shaders/surface.glsl.
inline const ImVec4 kRoiColor{0.55F, 0.65F, 0.80F, 1.0F};
inline const ImVec4 kHandleColor{0.95F, 0.80F, 0.25F, 1.0F};
inline const ImVec4 kBeltColor{0.85F, 0.30F, 0.25F, 1.0F};

/// Returns the screen coordinate of the right end of the current line. Call this at its start.
float right_end();

/// Returns the colour of the pair of corresponding points with this number. Consecutive numbers
/// have clearly different colours.
ImVec4 color_of_pair(std::size_t number);

/// Draws a square of that colour before an item with a frame, on the same line.
void draw_swatch(const ImVec4& color);
float swatch_width();

/// Draws a radio button after the last item, or on the next line if the current one, which ends at
/// the screen coordinate `right`, has no room for it. Returns whether it was pressed.
bool radio_on_line(const char* label, bool on, float right);

/// Draws choices after `label`, on one line if they fit. Sets `value` to the one that is clicked,
/// and returns whether one was. The label and the choices form one item, for `explain`.
template <typename Value>
bool choose(const char* label, Value& value,
            std::initializer_list<std::pair<const char*, Value>> choices) {
  const float right = right_end();
  ImGui::BeginGroup();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", label);
  ImGui::PushID(label);
  bool clicked = false;
  for (const auto& [name, choice] : choices) {
    if (!radio_on_line(name, value == choice, right)) continue;
    value = choice;
    clicked = true;
  }
  ImGui::PopID();
  ImGui::EndGroup();
  return clicked;
}

/// Writes a label at the left of a field. The next item takes the rest of the line.
void label_field(const char* label);
/// Prepares the rest of the line for a field after an item that serves as its label, such as a
/// checkbox.
void place_field();

/// Returns a number format for lengths, such as "%.4g mm". Without a unit, returns `format`.
std::string with_unit(const char* format, const std::string& unit);

/// Draws a button that is highlighted while `on`. Returns whether it was pressed.
bool toggle_button(const char* label, bool on);
float button_width(const char* label);

/// Keeps the next item on the current line if an item of `width` fits to the left of the screen
/// coordinate `right`.
void stay_on_line(float width, float right);

/// Draws a warning of the engine, and a button that does what it advises. Returns true if the
/// button was pressed.
bool draw_engine_warning(const Warning& warning);

void draw_colored(Tone tone, const std::string& text);

/// Adds a tooltip to the last item: `what` it is or does, and `more` below in grey. Lines wrap.
void explain(std::string_view what, std::string_view more = {});
/// Likewise, with the description and the key of an action.
void explain(Action action);

/// Places the next window in the centre of the main window.
void center_next_window(ImGuiCond when = ImGuiCond_Always);
/// Returns whether `key` was pressed while the current window was open. Ignores the key press that
/// opened the window.
bool is_pressed(ImGuiKey key);

ImVec2 to_imgui(const Eigen::Vector2d& vector);

}  // namespace lapwing::viewer
