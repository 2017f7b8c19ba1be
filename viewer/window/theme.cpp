#include "window/theme.h"

#include <filesystem>
#include <imgui.h>

namespace lapwing::viewer {
namespace {

constexpr float kFontPixels = 15.0F;         // of DejaVu Sans, at scale 1
constexpr float kBuiltInFontPixels = 13.0F;  // what ImGui's own bitmap is drawn for

void load_font(float scale) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  if (std::filesystem::exists(LAPWING_VIEWER_FONT)) {
    // Letters of other languages in file names.
    fonts.AddFontFromFileTTF(LAPWING_VIEWER_FONT, kFontPixels * scale, nullptr,
                             fonts.GetGlyphRangesCyrillic());
    return;
  }
  ImFontConfig config;
  config.SizePixels = kBuiltInFontPixels * scale;
  fonts.AddFontDefault(&config);
}

ImVec4 gray(float level, float opacity = 1.0F) {
  return {level, level, level * 1.04F, opacity};
}

void set_colors(ImGuiStyle& style) {
  ImGui::StyleColorsDark(&style);
  const ImVec4 accent(0.25F, 0.48F, 0.75F, 1.0F);
  const ImVec4 light_accent(0.32F, 0.58F, 0.88F, 1.0F);
  const auto set = [&](ImGuiCol which, const ImVec4& color) { style.Colors[which] = color; };
  set(ImGuiCol_Text, gray(0.92F));
  set(ImGuiCol_TextDisabled, gray(0.58F));
  set(ImGuiCol_WindowBg, gray(0.16F));
  set(ImGuiCol_PopupBg, gray(0.13F));
  set(ImGuiCol_MenuBarBg, gray(0.12F));
  set(ImGuiCol_Border, gray(0.28F));
  set(ImGuiCol_FrameBg, gray(0.23F));
  set(ImGuiCol_FrameBgHovered, gray(0.29F));
  set(ImGuiCol_FrameBgActive, gray(0.33F));
  set(ImGuiCol_TitleBgActive, gray(0.20F));
  set(ImGuiCol_Header, gray(0.22F));
  set(ImGuiCol_HeaderHovered, gray(0.30F));
  set(ImGuiCol_HeaderActive, gray(0.34F));
  set(ImGuiCol_Button, gray(0.28F));
  set(ImGuiCol_ButtonHovered, accent);
  set(ImGuiCol_ButtonActive, light_accent);
  set(ImGuiCol_CheckMark, light_accent);
  set(ImGuiCol_SliderGrab, accent);
  set(ImGuiCol_SliderGrabActive, light_accent);
  set(ImGuiCol_PlotHistogram, accent);
}

}  // namespace

void set_theme(double scale) {
  const auto factor = static_cast<float>(scale);
  load_font(factor);
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  set_colors(style);
  style.WindowRounding = 0.0F;
  style.FrameRounding = 3.0F;
  style.GrabRounding = 3.0F;
  style.ScrollbarRounding = 3.0F;
  style.WindowPadding = {10.0F, 8.0F};
  style.FramePadding = {7.0F, 4.0F};
  style.ItemSpacing = {8.0F, 5.0F};
  style.ScaleAllSizes(factor);
  ImGuiIO& io = ImGui::GetIO();
  // Panels have their places; a blinking cursor would need frames while nothing happens.
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigInputTextCursorBlink = false;
}

}  // namespace lapwing::viewer
