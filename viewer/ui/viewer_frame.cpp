// The panels that surround the picture: menu, sidebar, status line.

#include <cstdio>
#include <imgui.h>

#include "ui/viewer_app.h"

namespace lapwing::viewer {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

float status_height() {
  return ImGui::GetFrameHeight();
}

// Escape closes it. Between this, if true, and ImGui::EndMenu are its items.
bool begin_menu(const char* label) {
  if (!ImGui::BeginMenu(label)) return false;
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
  return true;
}

}  // namespace

void ViewerApp::draw_menu() {
  if (!ImGui::BeginMainMenuBar()) return;
  if (begin_menu("File")) {
    if (ImGui::MenuItem("Open...")) show_start_ = true;
    if (ImGui::MenuItem("Save picture...", "Ctrl+P", false, document_.has_value())) {
      perform(Action::save_picture);
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Quit", "Ctrl+Q")) quit_ = true;
    ImGui::EndMenu();
  }
  if (begin_menu("View")) {
    draw_view_menu();
    ImGui::EndMenu();
  }
  if (begin_menu("Help")) {
    if (ImGui::MenuItem("Controls", "?")) show_controls_ = true;
    ImGui::EndMenu();
  }
  ImGui::EndMainMenuBar();
}

void ViewerApp::draw_view_menu() {
  struct Item {
    const char* label;
    const char* keys;
    Action action;
  };
  constexpr Item kItems[]{{"Show all", "Home", Action::frame_all},
                          {"Front", "1", Action::view_front},
                          {"Back", "Ctrl+1", Action::view_back},
                          {"Right", "3", Action::view_right},
                          {"Left", "Ctrl+3", Action::view_left},
                          {"Top", "7", Action::view_top},
                          {"Bottom", "Ctrl+7", Action::view_bottom},
                          {"Three-quarter", "0", Action::view_three_quarter}};
  for (const Item& item : kItems) {
    if (ImGui::MenuItem(item.label, item.keys)) perform(item.action);
  }
  ImGui::Separator();
  if (ImGui::MenuItem("Parallel projection", "5", camera_.orthographic)) {
    perform(Action::toggle_projection);
  }
  if (ImGui::MenuItem("z points up", nullptr, up_axis_ == UpAxis::z)) {
    up_axis_ = up_axis_ == UpAxis::z ? UpAxis::y : UpAxis::z;
    look_from(View::three_quarter);
  }
  if (ImGui::MenuItem("Panels", "Tab", show_panels_)) perform(Action::toggle_panels);
  if (!begin_menu("Mouse as in")) return;
  for (std::size_t k = 0; k < keymaps().size(); ++k) {
    const std::string name(keymaps()[k].name);
    if (ImGui::MenuItem(name.c_str(), nullptr, keymap_ == k)) keymap_ = k;
  }
  ImGui::EndMenu();
}

void ViewerApp::draw_sidebar(const FrameTimings& last) {
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const float per_unit = static_cast<float>(size_.x()) / viewport.Size.x;
  ImGui::SetNextWindowPos(viewport.WorkPos);
  ImGui::SetNextWindowSize(
      {static_cast<float>(sidebar_pixels()) / per_unit, viewport.WorkSize.y - status_height()});
  if (ImGui::Begin("Panels", nullptr, kFixed)) {
    if (ImGui::CollapsingHeader("Mesh", ImGuiTreeNodeFlags_DefaultOpen)) {
      draw_mesh_panel(*document_);
    }
    if (ImGui::CollapsingHeader("Display", ImGuiTreeNodeFlags_DefaultOpen)) {
      draw_display_panel(display_, *document_);
    }
    if (ImGui::CollapsingHeader("Timings")) draw_timings_panel(last);
    if (ImGui::CollapsingHeader("Log")) draw_log_panel(log_);
  }
  ImGui::End();
}

void ViewerApp::draw_status(const FrameTimings& last) {
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(
      {viewport.WorkPos.x, viewport.WorkPos.y + viewport.WorkSize.y - status_height()});
  ImGui::SetNextWindowSize({viewport.WorkSize.x, status_height()});
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(style.WindowPadding.x, style.FramePadding.y));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
  if (ImGui::Begin("Status", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar)) {
    std::string text = context_->description().name;
    if (document_) {
      char numbers[96];
      std::snprintf(numbers, sizeof numbers, "  |  %zu vertices  |  %.1f ms",
                    document_->file.mesh.vertex_count(), last.draw_ms + last.ui_ms);
      text += numbers;
    }
    if (loader_.busy()) {
      text += "  |  " + loader_.stage() + " (Escape cancels)";
    } else if (!status_.empty()) {
      text += "  |  " + status_;
    } else {
      text += "  |  ? lists the controls";
    }
    ImGui::TextUnformatted(text.c_str());
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace lapwing::viewer
