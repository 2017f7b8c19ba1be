// The panels that surround the picture: menu, sidebar, status line.

#include <array>
#include <cstdio>
#include <imgui.h>
#include <utility>

#include "lapwing/base/errors.h"
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

// Without memory of its own: a frame allocates nothing.
void append(std::string& text, const char* format, auto... values) {
  std::array<char, 128> more{};
  std::snprintf(more.data(), more.size(), format, values...);
  text += more.data();
}

// For the status line: what the worker does, and what a drag shows.
void append_state(std::string& text, const Editor& editor) {
  using At = PreparationStatus::Phase;
  const PreparationStatus status = editor.session().preparation().status();
  const double percent = 100.0 * status.fraction;
  switch (status.phase) {
    case At::previewing:
    case At::solving:
      append(text, "  |  preparing: %s %.0f%%", status.stage.c_str(), percent);
      break;
    case At::settling:
      // What settles as it is dragged comes and goes with every frame.
      if (!editor.is_dragging()) append(text, "  |  settling %.0f%%", percent);
      break;
    case At::failed:
      text.append("  |  ").append(status.message);
      break;
    case At::idle:
    case At::ready:
      break;
  }
  const WorkStatus step = editor.session().step_status();
  if (step.busy) {
    append(text, "  |  carrying out: %s %.0f%%", step.stage.c_str(), 100.0 * step.fraction);
  }
  if (editor.shows_live_result()) {
    text += "  |  live";
  } else if (editor.surface().source() == SurfaceSource::preview) {
    text += "  |  preview";
  } else if (editor.surface().source() == SurfaceSource::exact) {
    text += "  |  exact";
  }
  if (editor.shown().shows_before()) text += "  |  before";
}

}  // namespace

void ViewerApp::draw_ui(const FrameTimings& last) {
  take_loaded();
  update_document();
  take_settled();
  carry_out_order();
  draw_menu();
  draw_status(last);
  if (document_) {
    const double per_unit = size_.x() / static_cast<double>(ImGui::GetMainViewport()->Size.x);
    marks_.draw(document_->editor, view_frame(), per_unit, cursor_);
    marks_.draw_transplant(document_->transplant, view_frame(), per_unit);
    if (const auto area = source_area()) {
      marks_.draw(document_->desk, document_->editor, view_frame(), area->corner, per_unit);
    }
    if (show_panels_) draw_sidebar(last);
    const bool deforms = !document_->desk.is_open() && !document_->transplant.is_open();
    const ImVec2 top = ImGui::GetMainViewport()->WorkPos;
    const double gap = 0.5 * static_cast<double>(ImGui::GetFontSize());
    Eigen::Vector2d corner(sidebar_pixels() / per_unit + static_cast<double>(top.x) + gap,
                           static_cast<double>(top.y) + gap);
    const ImVec2 below = ImGui::GetMainViewport()->WorkSize;
    const Eigen::Vector2d end(top.x + below.x, top.y + below.y - status_height());
    if (const double taken = draw_banner(corner, end); taken > 0.0) corner.y() += taken + gap;
    const bool edits = !document_->banner.is_empty() && !document_->banner.has_picture();
    if (show_panels_ && deforms && edits) {
      draw_guide(document_->editor, corner);
    }
  }
  draw_dialogs();
  if (document_) ++frames_shown_;
}

void ViewerApp::update_document() {
  if (!document_) return;
  Editor& editor = document_->editor;
  LayerDesk& desk = document_->desk;
  TransplantDesk& transplant = document_->transplant;
  editor.update();
  // Both preview on the surface: the one begun last stays.
  if (desk.is_open() && transplant.is_open()) {
    transplants_ ? transplant.close(editor) : desk.close(editor);
  }
  transplants_ = transplant.is_open();
  desk.update(editor);
  transplant.update(editor);
  document_->banner.update(editor, desk.is_open() || transplant.is_open());
  part_pictures_.renew(transplant.shelf(), *context_);
  const auto area = source_area();
  if (area) document_->desk.view()->resize(area->size);
  camera_.target_across = covered_share();
  // What is left of the window is another part of it.
  if (std::exchange(shows_source_, area.has_value()) != area.has_value()) frame_all();
}

void ViewerApp::draw_dialogs() {
  if (!interrupted_.empty()) {
    draw_interrupted();
  } else if (show_start_ && !chooser_.is_open() && !loader_.status().busy) {
    draw_start();
  }
  if (overwriting_) {
    // Before the dialogs that lead to it: what is pressed there is no answer here.
    if (const auto writes = draw_overwrite_panel(overwriting_->file)) answer_overwriting(*writes);
  } else {
    if (picture_plan_.open && document_) draw_picture();
    if (const auto chosen = chooser_.draw()) use_path(*chosen);
    if (leaving_for_ && !chooser_.is_open() && !overwriting_) draw_unsaved();
  }
  if (show_controls_) draw_controls_list(keymaps()[keymap_], show_controls_);
}

void ViewerApp::draw_interrupted() {
  using What = InterruptedChoice::What;
  const auto choice = draw_interrupted_panel(interrupted_);
  if (!choice) return;
  if (choice->what == What::later) return interrupted_.clear();
  const InterruptedEdit edit = interrupted_[choice->edit];
  interrupted_.erase(interrupted_.begin() + static_cast<std::ptrdiff_t>(choice->edit));
  if (choice->what == What::discard) return discard(edit);
  interrupted_.clear();
  leave_for([this, edit] {
    load({edit.opened}, [edit](Kernels& kernels, const Progress& progress) {
      return load_interrupted(edit, kernels, progress);
    });
  });
}

void ViewerApp::draw_unsaved() {
  const auto choice = draw_unsaved_panel(document_->opened.name);
  if (!choice) return;
  if (*choice == UnsavedChoice::save && document_->save_path.empty()) {
    return ask_for_path(PathPurpose::save_mesh);
  }
  const auto action = std::exchange(leaving_for_, nullptr);
  if (*choice == UnsavedChoice::save) return save_to(document_->save_path, action);
  if (*choice == UnsavedChoice::discard) action();
}

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
    ImGui::EndMenu();
  }
  ImGui::EndMainMenuBar();
}

void ViewerApp::draw_file_menu() {
  const bool is_open = document_ != nullptr;
  const auto item = [&](const char* label, const char* keys, Action action) {
    if (ImGui::MenuItem(label, keys, false, is_open)) perform(action);
  };
  if (ImGui::MenuItem("Open...", "Ctrl+O")) perform(Action::open);
  draw_recent_menu();
  if (ImGui::MenuItem("Samples and shapes...")) show_start_ = true;
  item("Save", "Ctrl+S", Action::save);
  item("Save as...", "Ctrl+Shift+S", Action::save_as);
  item("Save picture...", "Ctrl+P", Action::save_picture);
  ImGui::Separator();
  item("Carry a file along...", nullptr, Action::carry_file);
  item("Save carried objects", nullptr, Action::save_carried);
  ImGui::Separator();
  item("Save recipe...", "Ctrl+E", Action::save_recipe);
  item("Replay a recipe...", "Ctrl+R", Action::replay_recipe);
  ImGui::Separator();
  if (ImGui::MenuItem("Quit", "Ctrl+Q")) ask_to_close();
}

void ViewerApp::draw_edit_menu() {
  struct Item {
    const char* label;
    const char* keys;
    Action action;
  };
  constexpr Item kItems[]{{"Undo", "Ctrl+Z", Action::undo},
                          {"Redo", "Ctrl+Shift+Z", Action::redo},
                          {"New edit", "Ctrl+N", Action::new_edit},
                          {"Choose ROI", "I", Action::choose_roi},
                          {"Choose handle", "H", Action::choose_handle},
                          {"Add a handle", "Shift+H", Action::add_handle},
                          {"Choose belt", "T", Action::choose_belt},
                          {"Choose all", "Ctrl+A", Action::select_all},
                          {"Choose nothing", "Ctrl+Shift+A", Action::clear},
                          {"Grow", "Ctrl+=", Action::grow},
                          {"Shrink", "Ctrl+-", Action::shrink},
                          {"Invert", "Ctrl+I", Action::invert},
                          {"Remove handle", "Delete", Action::remove_handle},
                          {"Coat the ROI...", "Ctrl+K", Action::begin_coat},
                          {"Mix on the ROI...", "Ctrl+M", Action::begin_mix}};
  for (const Item& item : kItems) {
    if (ImGui::MenuItem(item.label, item.keys, false, document_ != nullptr)) perform(item.action);
  }
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
    if (!ImGui::MenuItem(name.c_str(), nullptr, keymap_ == k)) continue;
    keymap_ = k;
    if (document_) document_->editor.set_gizmo_keys(gizmo_keys());
  }
  ImGui::EndMenu();
}

// A coat, mix or transplant that is open takes the place of the deform.
void ViewerApp::draw_operations(Editor& editor) {
  LayerDesk& desk = document_->desk;
  TransplantDesk& transplant = document_->transplant;
  const bool is_open = desk.is_open() || transplant.is_open();
  if (!is_open && ImGui::CollapsingHeader("Deform", ImGuiTreeNodeFlags_DefaultOpen)) {
    if (auto vertices = draw_deform_panel(editor, drafts_)) {
      frame(*vertices);
      editor.point_at(*std::move(vertices));
    }
  }
  if (desk.is_open()) ImGui::SetNextItemOpen(true);
  if (ImGui::CollapsingHeader("Coat and mix")) {
    if (const auto purpose = draw_layer_panel(desk, editor)) ask_for_path(*purpose);
  }
  if (transplant.is_open()) ImGui::SetNextItemOpen(true);
  if (ImGui::CollapsingHeader("Transplant")) {
    if (const auto purpose = draw_transplant_panel(transplant, part_pictures_, editor, drafts_)) {
      ask_for_path(*purpose);
    }
  }
}

void ViewerApp::draw_sidebar(const FrameTimings& last) {
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const float per_unit = static_cast<float>(size_.x()) / viewport.Size.x;
  ImGui::SetNextWindowPos(viewport.WorkPos);
  ImGui::SetNextWindowSize(
      {static_cast<float>(sidebar_pixels()) / per_unit, viewport.WorkSize.y - status_height()});
  if (ImGui::Begin("Panels", nullptr, kFixed)) {
    Editor& editor = document_->editor;
    constexpr auto kOpen = ImGuiTreeNodeFlags_DefaultOpen;
    if (ImGui::CollapsingHeader("Mesh")) draw_mesh_panel(*document_);
    if (ImGui::CollapsingHeader("Selection", kOpen)) draw_selection_panel(editor, drafts_);
    draw_operations(editor);
    if (!editor.state().carried.empty()) ImGui::SetNextItemOpen(true, ImGuiCond_Once);
    if (ImGui::CollapsingHeader("Carried objects")) {
      if (const auto wanted = draw_carried_panel(editor)) perform(*wanted);
    }
    if (ImGui::CollapsingHeader("Display", kOpen)) draw_display_panel(display_, editor);
    if (ImGui::CollapsingHeader("History", kOpen)) {
      if (const auto purpose = draw_history_panel(editor, drafts_)) ask_for_path(*purpose);
    }
    if (ImGui::CollapsingHeader("Timings")) draw_timings_panel(last);
    if (ImGui::CollapsingHeader("Log")) draw_log_panel(log_);
  }
  ImGui::End();
}

// Device and size, what is on the screen, and what to do.
const std::string& ViewerApp::status_text() {
  std::string& text = status_line_;
  text = context_->description().name;
  if (document_) {
    const Editor& editor = document_->editor;
    append(text, "  |  %zu vertices", editor.positions().size());
    const Certificate* certificate = editor.session().certificate();
    if (certificate != nullptr && editor.state().parameters.settle) {
      append(text, "  |  balance %.0e", certificate->relative_gradient);
    } else if (certificate != nullptr) {
      append(text, "  |  residual %.0e", certificate->relative_residual);
    }
    append_state(text, editor);
  }
  text += "  |  ";
  if (const WorkStatus loading = loader_.status(); loading.busy) {
    text.append(loading_.file.filename().string())
        .append(": ")
        .append(loading.stage)
        .append(" (Escape cancels)");
  } else if (!status_.empty()) {
    text += status_;
  } else {
    text += document_ ? document_->editor.hint() : "? lists the controls";
  }
  return text;
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
    // How long a frame takes changes its width with every frame: it stands at the right end, where
    // it moves no other word.
    std::array<char, 32> drawn{};
    std::snprintf(drawn.data(), drawn.size(), "%.1f ms", last.draw_ms + last.ui_ms);
    const float at =
        viewport.WorkSize.x - style.WindowPadding.x - ImGui::CalcTextSize(drawn.data()).x;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::PushClipRect(
        corner,
        {viewport.WorkPos.x + at - style.ItemSpacing.x, corner.y + ImGui::GetTextLineHeight()},
        true);
    ImGui::TextUnformatted(status_text().c_str());
    ImGui::PopClipRect();
    ImGui::SameLine(at);
    ImGui::TextUnformatted(drawn.data());
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace lapwing::viewer
