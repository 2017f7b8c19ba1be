#include "ui/widgets.h"

#include <algorithm>

#include "window/theme.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

// Width at which a tooltip wraps, in letters of the font.
constexpr float kTooltipLetters = 28.0F;
// Share of the panel's width that labels take.
constexpr float kLabelShare = 0.42F;

}  // namespace

ImVec4 color_of_pair(std::size_t number) {
  constexpr float kGoldenRatio = 0.618F;
  ImVec4 color{0.0F, 0.0F, 0.0F, 1.0F};
  ImGui::ColorConvertHSVtoRGB(std::fmod(kGoldenRatio * static_cast<float>(number), 1.0F), 0.75F,
                              1.0F, color.x, color.y, color.z);
  return color;
}

void draw_swatch(const ImVec4& color) {
  const float side = 0.7F * ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float top = at.y + 0.5F * (ImGui::GetFrameHeight() - side);
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + side, top + side},
                                            ImGui::GetColorU32(color),
                                            0.13F * ImGui::GetFontSize());
  ImGui::Dummy({side, ImGui::GetFrameHeight()});
  ImGui::SameLine(0.0F, 0.25F * ImGui::GetFontSize());
}

float swatch_width() {
  return 0.95F * ImGui::GetFontSize();
}

void place_field() {
  const float column = kLabelShare * ImGui::GetContentRegionMax().x;
  const float after = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + ImGui::GetScrollX() +
                      ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SameLine(std::max(column, after));
  ImGui::SetNextItemWidth(-1.0F);
}

void label_field(const char* label) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  place_field();
}

std::string with_unit(const char* format, const std::string& unit) {
  std::string text(format);
  if (unit.empty()) return text;
  // A unit is the user's text, and a percent sign in it is no format.
  text += ' ';
  for (const char c : unit) text += c == '%' ? std::string("%%") : std::string(1, c);
  return text;
}

bool toggle_button(const char* label, bool on) {
  if (on) {
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_TabActive));
  }
  const bool pressed = ImGui::Button(label);
  if (on) ImGui::PopStyleColor();
  return pressed;
}

float button_width(const char* label) {
  return ImGui::CalcTextSize(label).x + 2.0F * ImGui::GetStyle().FramePadding.x;
}

void stay_on_line(float width, float right) {
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  if (ImGui::GetItemRectMax().x + spacing + width <= right) ImGui::SameLine();
}

bool radio_on_line(const char* label, bool on, float right) {
  const float width = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x +
                      ImGui::CalcTextSize(label, nullptr, true).x;
  stay_on_line(width, right);
  return ImGui::RadioButton(label, on);
}

float right_end() {
  return ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
}

void draw_colored(Tone tone, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, text_color(tone));
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

bool draw_engine_warning(const Warning& warning) {
  draw_colored(Tone::warning, in_window_words(warning.text));
  const auto [label, what] = [&]() -> std::pair<const char*, const char*> {
    switch (warning.advice) {
      case Advice::none:
        break;
      case Advice::set_transition_width:
        return {"Set transition width", "Sets \"Transition width\" to a value that fits."};
      case Advice::set_scale:
        return {"Set scale", "Gives the detail the mean scale of the patches everywhere."};
      case Advice::negate_amplitude:
        return {"Negate amplitude", "Turns dents into bumps."};
      case Advice::refine_target:
        return {"Remesh region",
                "Cancels this operation and remeshes the region with half the edge length. Then "
                "select the region again."};
      case Advice::enlarge_hole:
        return {"Enlarge hole", "Enlarges the hole in the mesh by half."};
    }
    return {};
  }();
  if (label == nullptr) return false;
  ImGui::PushID(warning.text.c_str());
  const bool pressed = ImGui::SmallButton(label);
  ImGui::PopID();
  explain(what);
  return pressed;
}

void explain(std::string_view what, std::string_view more) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kTooltipLetters * ImGui::GetFontSize());
  ImGui::TextUnformatted(what.data(), what.data() + what.size());
  if (!more.empty()) ImGui::TextDisabled("%.*s", static_cast<int>(more.size()), more.data());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void explain(Action action) {
  if (!ImGui::IsItemHovered()) return;
  const ControlLine control = control_of(action);
  explain(control.what, control.how.empty() ? std::string() : "Shortcut: " + control.how);
}

void center_next_window(ImGuiCond when) {
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), when, {0.5F, 0.5F});
}

bool is_pressed(ImGuiKey key) {
  return !ImGui::IsWindowAppearing() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false);
}

ImVec2 to_imgui(const Eigen::Vector2d& vector) {
  return {static_cast<float>(vector.x()), static_cast<float>(vector.y())};
}

}  // namespace lapwing::viewer
