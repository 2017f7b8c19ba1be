// Draws the Display tab.

#include <algorithm>
#include <array>
#include <cstdio>
#include <imgui.h>
#include <string>
#include <utility>

#include "lapwing/base/srgb.h"
#include "navigation/keymap.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

enum class Shading { solid, wireframe, xray };

ImU32 encoded(const Eigen::Vector3f& linear) {
  return IM_COL32(srgb_byte_of(linear[0]), srgb_byte_of(linear[1]), srgb_byte_of(linear[2]), 255);
}

}  // namespace

void draw_legend(const SurfaceStyle& style) {
  constexpr int kParts = 24;
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = ImGui::GetFontSize();
  for (int p = 0; p < kParts; ++p) {
    const auto at = [&](int part) { return static_cast<float>(part) / kParts; };
    const ImU32 left = encoded(map_color(style.color_map, at(p)));
    const ImU32 right = encoded(map_color(style.color_map, at(p + 1)));
    ImGui::GetWindowDrawList()->AddRectFilledMultiColor(
        {from.x + width * at(p), from.y}, {from.x + width * at(p + 1), from.y + height}, left,
        right, right, left);
  }
  ImGui::Dummy({width, height});
  const ScalarRange range = style.range.value_or(ScalarRange{});
  ImGui::Text("%.3g", static_cast<double>(range.low));
  char high[32];
  std::snprintf(high, sizeof high, "%.3g", static_cast<double>(range.high));
  ImGui::SameLine(std::max(0.0F, ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(high).x));
  ImGui::TextUnformatted(high);
}

namespace {

void choose_coloring(Coloring& coloring) {
  constexpr std::array kChoices{std::pair{"Plain", Coloring::plain},
                                std::pair{"Regions", Coloring::regions},
                                std::pair{"Displacement", Coloring::displacement},
                                std::pair{"Rotation", Coloring::rotation},
                                std::pair{"Detail error", Coloring::detail},
                                std::pair{"Stretch", Coloring::stretch}};
  constexpr std::size_t kColumns = 3;
  ImGui::TextDisabled("Colour");
  for (std::size_t c = 0; c < kChoices.size(); ++c) {
    const float place = static_cast<float>(c % kColumns) / kColumns;
    if (c % kColumns > 0) ImGui::SameLine(place * ImGui::GetContentRegionMax().x);
    if (ImGui::RadioButton(kChoices[c].first, coloring == kChoices[c].second)) {
      coloring = kChoices[c].second;
    }
  }
}

}  // namespace

std::optional<PoseMeasure> measure_of(Coloring coloring) {
  // The order is that of Coloring, without its first two values, which display no measure.
  constexpr std::array kMeasures{PoseMeasure::displacement, PoseMeasure::rotation,
                                 PoseMeasure::detail, PoseMeasure::stretch};
  const auto number = static_cast<std::size_t>(coloring);
  if (number < 2) return {};
  return kMeasures[number - 2];
}

SurfaceStyle style_of(const DisplayChoices& choices, const Editor& editor) {
  SurfaceStyle style = choices.style;
  style.color = choices.coloring == Coloring::plain ? SurfaceColor::plain : SurfaceColor::regions;
  const ShownSurface& shown = editor.view().shown();
  if ((measure_of(choices.coloring) || shown.has_numbers()) && shown.is_measured()) {
    style.color = SurfaceColor::scalar;
    style.range = shown.measure_range();
  }
  return style;
}

void draw_display_panel(DisplayChoices& choices, Editor& editor) {
  SurfaceStyle& style = choices.style;
  Shading shading = style.xray        ? Shading::xray
                    : style.wireframe ? Shading::wireframe
                                      : Shading::solid;
  if (choose("Shading", shading,
             {{"Solid", Shading::solid},
              {"Wireframe", Shading::wireframe},
              {"X-ray", Shading::xray}})) {
    style.wireframe = shading == Shading::wireframe;
    style.xray = shading == Shading::xray;
  }
  choose("Matcap", style.matcap,
         {{"Off", Matcap::none},
          {"Clay", Matcap::clay},
          {"Metal", Matcap::metal},
          {"Pearl", Matcap::pearl}});
  ImGui::Checkbox("Flat shading", &style.flat);
  const auto next_to = [](const char* label) {
    stay_on_line(button_width(label) + ImGui::GetFrameHeight(), right_end());
  };
  next_to("Original");
  bool before = editor.view().shown().shows_before();
  if (ImGui::Checkbox("Original", &before)) editor.view().show_before(before);
  explain("Shows the mesh as it was opened.", "Shortcut: C");
  next_to("Ground grid");
  ImGui::Checkbox("Ground grid", &choices.grid);
  explain("A grid under the mesh as it was opened. The red line is the x axis.");
  if (editor.view().shown().has_file_colors()) {
    next_to("File colours");
    ImGui::Checkbox("File colours", &style.file_colors);
  }
  label_field("Feature angle");
  ImGui::SliderFloat("##feature", &choices.feature_angle, 0.0F, 180.0F, "%.0f°",
                     ImGuiSliderFlags_AlwaysClamp);
  // A new angle rebuilds the surface, which takes too long to do in every frame of the slider drag.
  if (ImGui::IsItemDeactivatedAfterEdit()) editor.view().set_feature_angle(choices.feature_angle);
  explain("Edges whose faces meet at a larger angle are shaded as sharp edges.");
  choose_coloring(choices.coloring);
  const auto measure = measure_of(choices.coloring);
  editor.view().shown().color_by(measure);
  if (measure && !editor.view().shown().is_comparable()) {
    ImGui::TextDisabled("The triangles have changed, so there is\nnothing to compare with.");
  }
  if (measure && editor.view().shown().is_measured() && !editor.view().shown().has_numbers()) {
    std::string title(legend_title(*measure));
    std::replace(title.begin(), title.end(), '\n', ' ');
    ImGui::TextDisabled("%s", in_window_words(title).c_str());
    draw_legend(style_of(choices, editor));
  }
  choose("Background", choices.background,
         {{"Gradient", Background::gradient},
          {"White", Background::white},
          {"Transparent", Background::transparent}});
}

void draw_preferences_panel(Preferences& preferences) {
  const float right = right_end();
  choose("Theme", preferences.theme, {{"Dark", Theme::dark}, {"Light", Theme::light}});
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Mouse navigation");
  for (const Keymap& keymap : keymaps()) {
    const std::string name(keymap.name);
    if (radio_on_line(name.c_str(), preferences.mouse == name, right)) preferences.mouse = name;
  }
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Unit");
  for (const char* unit : {"", "mm", "cm", "m", "in"}) {
    const char* name = *unit == '\0' ? "None" : unit;
    if (radio_on_line(name, preferences.unit == unit, right)) preferences.unit = unit;
    explain("Shown after lengths. Files store numbers without a unit.");
  }
  ImGui::Checkbox("Show guide", &preferences.shows_guide);
  explain("Shows the next step in the view.");
  ImGui::Checkbox("Use system file dialogs", &preferences.uses_system_dialogs);
  explain("Requires zenity or kdialog. Off: the built-in file browser.");
}

}  // namespace lapwing::viewer
