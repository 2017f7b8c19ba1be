// The menu bar.

#include <array>
#include <imgui.h>
#include <string>

#include "files/path_text.h"
#include "ui/viewer_app.h"

namespace lapwing::viewer {
namespace {

struct Item {
  const char* label;  // null for a divider between items
  Action action;
};
constexpr Item kDivider{nullptr, Action::quit};

// Begins a menu that Escape closes. If it returns true, draw items and call ImGui::EndMenu.
bool begin_menu(const char* label) {
  // In a low window, a long menu scrolls. Otherwise it would cover the menu bar.
  const float below_bar = ImGui::GetIO().DisplaySize.y - 1.5F * ImGui::GetFrameHeight();
  ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, {ImGui::GetIO().DisplaySize.x, below_bar});
  if (!ImGui::BeginMenu(label)) return false;
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
  return true;
}

// Draws items that are enabled if `is_open`. Returns the action of the one that was chosen.
std::optional<Action> draw_items(std::span<const Item> items, bool is_open) {
  std::optional<Action> chosen;
  for (const Item& item : items) {
    if (item.label == nullptr) {
      ImGui::Separator();
    } else if (ImGui::MenuItem(item.label, control_of(item.action).how.c_str(), false, is_open)) {
      chosen = item.action;
    }
  }
  return chosen;
}

}  // namespace

void ViewerApp::draw_menu() {
  if (!ImGui::BeginMainMenuBar()) return;
  if (begin_menu("File")) {
    draw_file_menu();
    ImGui::EndMenu();
  }
  if (begin_menu("Edit")) {
    draw_edit_menu();
    ImGui::EndMenu();
  }
  if (begin_menu("View")) {
    draw_view_menu();
    ImGui::EndMenu();
  }
  if (begin_menu("Help")) {
    if (ImGui::MenuItem("Controls", "?")) show_controls_ = true;
    ImGui::MenuItem("Guide", nullptr, &preferences_.shows_guide);
    ImGui::MenuItem("Messages", nullptr, &show_messages_);
    ImGui::MenuItem("System info", nullptr, &show_machine_);
    ImGui::EndMenu();
  }
  ImGui::EndMainMenuBar();
}

void ViewerApp::draw_file_menu() {
  constexpr std::array kItems{Item{"Save", Action::save},
                              Item{"Save as...", Action::save_as},
                              Item{"Save image...", Action::save_picture},
                              Item{"Save turntable...", Action::save_turntable},
                              kDivider,
                              Item{"Attach object...", Action::carry_file},
                              Item{"Save attached objects", Action::save_carried},
                              kDivider,
                              Item{"Save recipe...", Action::save_recipe},
                              Item{"Replay recipe...", Action::replay_recipe},
                              kDivider};
  if (ImGui::MenuItem("Open...", "Ctrl+O")) perform(Action::open);
  draw_recent_menu();
  if (ImGui::MenuItem("Samples and primitives...")) files_.show_start();
  if (const auto action = draw_items(kItems, document_ != nullptr)) perform(*action);
  if (ImGui::MenuItem("Quit", "Ctrl+Q")) ask_to_close();
}

void ViewerApp::draw_recent_menu() {
  if (!begin_menu("Open recent")) return;
  if (ImGui::IsWindowAppearing()) dialogs_.recent().reload();
  std::optional<std::filesystem::path> chosen;
  for (const RecentFiles::Item& item : dialogs_.recent().items()) {
    if (ImGui::MenuItem(with_tilde(item.path).c_str(), nullptr, false, item.is_there)) {
      chosen = item.path;
    }
  }
  if (dialogs_.recent().items().empty()) ImGui::TextDisabled("No recent files.");
  ImGui::Separator();
  if (ImGui::MenuItem("Clear recent files", nullptr, false, !dialogs_.recent().items().empty()))
    dialogs_.recent().clear();
  ImGui::EndMenu();
  if (chosen) files_.open(*chosen);
}

void ViewerApp::draw_edit_menu() {
  constexpr std::array kItems{Item{"Undo", Action::undo},
                              Item{"Redo", Action::redo},
                              kDivider,
                              Item{"New edit", Action::new_edit},
                              Item{"Select region", Action::choose_roi},
                              Item{"Select handle", Action::choose_handle},
                              Item{"Add handle", Action::add_handle},
                              Item{"Select fixed border", Action::choose_belt},
                              Item{"Remove handle", Action::remove_handle},
                              kDivider,
                              Item{"Select all", Action::select_all},
                              Item{"Select none", Action::clear},
                              Item{"Grow selection", Action::grow},
                              Item{"Shrink selection", Action::shrink},
                              Item{"Invert selection", Action::invert},
                              kDivider,
                              Item{"Paint stiffness", Action::take_stiffness},
                              Item{"Measure", Action::take_ruler},
                              kDivider,
                              Item{"Coat...", Action::begin_coat},
                              Item{"Mix...", Action::begin_mix},
                              Item{"Wrap onto a scan...", Action::begin_wrap},
                              Item{"Transplant part...", Action::take_part}};
  if (const auto action = draw_items(kItems, document_ != nullptr)) perform(*action);
}

void ViewerApp::draw_view_menu() {
  constexpr std::array kItems{Item{"Frame all", Action::frame_all},
                              Item{"Frame selected", Action::frame_selection},
                              kDivider,
                              Item{"Front", Action::view_front},
                              Item{"Back", Action::view_back},
                              Item{"Right", Action::view_right},
                              Item{"Left", Action::view_left},
                              Item{"Top", Action::view_top},
                              Item{"Bottom", Action::view_bottom},
                              Item{"Three-quarter", Action::view_three_quarter},
                              kDivider};
  if (const auto action = draw_items(kItems, true)) perform(*action);
  if (ImGui::MenuItem("Orthographic", "5", viewport_.camera().camera().orthographic)) {
    perform(Action::toggle_projection);
  }
  if (ImGui::MenuItem("Wireframe", "Shift+Z", display_.style.wireframe)) {
    perform(Action::toggle_wireframe);
  }
  if (ImGui::MenuItem("X-ray", "Alt+Z", display_.style.xray)) perform(Action::toggle_xray);
  if (ImGui::MenuItem("Compare with original", "Shift+C", viewport_.has_slider())) {
    perform(Action::toggle_slider);
  }
  ImGui::MenuItem("Ground grid", nullptr, &display_.grid);
  const bool is_z_up = viewport_.camera().up_axis() == UpAxis::z;
  if (ImGui::MenuItem("Z up", nullptr, is_z_up)) {
    viewport_.set_up_axis(is_z_up ? UpAxis::y : UpAxis::z);
  }
  if (ImGui::MenuItem("Panels", "Tab", viewport_.panels.are_shown)) perform(Action::toggle_panels);
  if (begin_menu("Theme")) {
    for (const auto& [name, theme] : {std::pair{"Dark", Theme::dark}, {"Light", Theme::light}}) {
      if (ImGui::MenuItem(name, nullptr, preferences_.theme == theme)) preferences_.theme = theme;
    }
    ImGui::EndMenu();
  }
  if (!begin_menu("Mouse navigation")) return;
  for (const Keymap& each : keymaps()) {
    const std::string name(each.name);
    if (ImGui::MenuItem(name.c_str(), nullptr, preferences_.mouse == name))
      preferences_.mouse = name;
  }
  ImGui::EndMenu();
}

}  // namespace lapwing::viewer
