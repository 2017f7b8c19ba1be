#include "window/theme.h"

#include <algorithm>
#include <array>
#include <filesystem>

namespace lapwing::viewer {
namespace {

constexpr float kFontPixels = 15.0F;         // size of DejaVu Sans at scale 1
constexpr float kClickUnits = 6.0F;          // largest motion of a click at scale 1
constexpr float kBuiltInFontPixels = 13.0F;  // size of ImGui's bitmap font

void load_font(float scale) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  if (std::filesystem::exists(LAPWING_VIEWER_FONT)) {
    // File names may contain Cyrillic letters.
    fonts.AddFontFromFileTTF(LAPWING_VIEWER_FONT, kFontPixels * scale, nullptr,
                             fonts.GetGlyphRangesCyrillic());
    return;
  }
  ImFontConfig config;
  config.SizePixels = kBuiltInFontPixels * scale;
  fonts.AddFontDefault(&config);
}

ImVec4 gray(float level, float opacity = 1.0F) {
  return {level, level, std::min(1.02F * level, 1.0F), opacity};
}

// Gray levels of a theme.
struct Grays {
  float text;
  float quiet_text;
  float window;
  float popup;
  float menu;
  float border;
  float frame;  // fields; `step` is added under the cursor, and twice `step` when pressed
  float step;
  float header;
  float button;
};
// The colours that depend on the theme.
struct Palette {
  Grays gray;
  ImVec4 accent;         // background of text
  ImVec4 strong_accent;  // background of pressed text
  ImVec4 mark;           // check marks and grips; never a background of text
  std::array<ImVec4, 3> tones;
};

const Palette kDark{{0.92F, 0.64F, 0.16F, 0.13F, 0.12F, 0.28F, 0.21F, 0.03F, 0.22F, 0.26F},
                    {0.17F, 0.36F, 0.58F, 1.0F},
                    {0.13F, 0.30F, 0.52F, 1.0F},
                    {0.36F, 0.62F, 0.92F, 1.0F},
                    {ImVec4{0.92F, 0.92F, 0.96F, 1.0F}, ImVec4{0.95F, 0.76F, 0.30F, 1.0F},
                     ImVec4{1.0F, 0.56F, 0.52F, 1.0F}}};
const Palette kLight{{0.09F, 0.33F, 0.94F, 0.98F, 0.90F, 0.70F, 0.86F, -0.03F, 0.88F, 0.82F},
                     {0.62F, 0.78F, 0.96F, 1.0F},
                     {0.52F, 0.71F, 0.93F, 1.0F},
                     {0.13F, 0.40F, 0.74F, 1.0F},
                     {ImVec4{0.09F, 0.09F, 0.10F, 1.0F}, ImVec4{0.45F, 0.29F, 0.0F, 1.0F},
                      ImVec4{0.66F, 0.08F, 0.06F, 1.0F}}};

const Palette* current = &kDark;

void set_colors(ImGuiStyle& style, const Palette& p) {
  const auto set = [&](ImGuiCol which, const ImVec4& color) { style.Colors[which] = color; };
  set(ImGuiCol_Text, gray(p.gray.text));
  set(ImGuiCol_TextDisabled, gray(p.gray.quiet_text));
  set(ImGuiCol_WindowBg, gray(p.gray.window));
  set(ImGuiCol_PopupBg, gray(p.gray.popup));
  set(ImGuiCol_MenuBarBg, gray(p.gray.menu));
  set(ImGuiCol_Border, gray(p.gray.border));
  set(ImGuiCol_FrameBg, gray(p.gray.frame));
  set(ImGuiCol_FrameBgHovered, gray(p.gray.frame + p.gray.step));
  set(ImGuiCol_FrameBgActive, gray(p.gray.frame + 2.0F * p.gray.step));
  set(ImGuiCol_TitleBg, gray(p.gray.header));
  set(ImGuiCol_TitleBgActive, gray(p.gray.header));
  set(ImGuiCol_Header, gray(p.gray.header));
  set(ImGuiCol_HeaderHovered, gray(p.gray.header + p.gray.step));
  set(ImGuiCol_HeaderActive, gray(p.gray.header + 2.0F * p.gray.step));
  set(ImGuiCol_Button, gray(p.gray.button));
  set(ImGuiCol_ButtonHovered, p.accent);
  set(ImGuiCol_ButtonActive, p.strong_accent);
  set(ImGuiCol_Tab, gray(p.gray.header));
  set(ImGuiCol_TabHovered, p.accent);
  set(ImGuiCol_TabActive, p.accent);
  set(ImGuiCol_TabUnfocused, gray(p.gray.header));
  set(ImGuiCol_TabUnfocusedActive, p.accent);
  set(ImGuiCol_Separator, gray(p.gray.border));
  set(ImGuiCol_SeparatorHovered, p.mark);
  set(ImGuiCol_SeparatorActive, p.mark);
  set(ImGuiCol_CheckMark, p.mark);
  set(ImGuiCol_SliderGrab, p.accent);
  set(ImGuiCol_SliderGrabActive, p.strong_accent);
  set(ImGuiCol_PlotHistogram, p.accent);
  set(ImGuiCol_TextSelectedBg, p.accent);
  set(ImGuiCol_TableHeaderBg, gray(p.gray.header));
  // A modal dialog does not darken the view.
  set(ImGuiCol_ModalWindowDimBg, {});
}

}  // namespace

void set_fonts(double scale) {
  load_font(static_cast<float>(scale));
}

void set_theme(Theme theme, double scale) {
  const bool is_light = theme == Theme::light;
  current = is_light ? &kLight : &kDark;
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  is_light ? ImGui::StyleColorsLight(&style) : ImGui::StyleColorsDark(&style);
  set_colors(style, *current);
  style.DisabledAlpha = 0.85F;
  style.WindowRounding = 0.0F;
  style.FrameRounding = 3.0F;
  style.GrabRounding = 3.0F;
  style.TabRounding = 3.0F;
  style.ScrollbarRounding = 3.0F;
  style.WindowPadding = {10.0F, 8.0F};
  style.FramePadding = {7.0F, 4.0F};
  style.ItemSpacing = {8.0F, 5.0F};
  style.ScaleAllSizes(static_cast<float>(scale));
  ImGuiIO& io = ImGui::GetIO();
  // The layout of the panels is fixed, so ImGui saves no settings. A blinking text cursor would
  // require frames while the window is idle.
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigInputTextCursorBlink = false;
  // The largest motion of the cursor during a click.
  io.MouseDragThreshold = kClickUnits * static_cast<float>(scale);
  io.MouseDoubleClickMaxDist = kClickUnits * static_cast<float>(scale);
}

const ImVec4& text_color(Tone tone) {
  return current->tones[static_cast<std::size_t>(tone)];
}

}  // namespace lapwing::viewer
