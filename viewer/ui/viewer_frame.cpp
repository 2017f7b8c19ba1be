// The parts of a frame other than menu and sidebar.

#include <algorithm>
#include <array>
#include <cstdio>
#include <imgui.h>
#include <utility>

#include "lapwing/base/errors.h"
#include "ui/draw_axis_gizmo.h"
#include "ui/viewer_app.h"
#include "ui/widgets.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

// Formats into a local array, so that a frame allocates nothing.
void append(std::string& text, const char* format, auto... values) {
  std::array<char, 128> more{};
  std::snprintf(more.data(), more.size(), format, values...);
  text += more.data();
}

void append_part(std::string& text, const char* format, auto... values) {
  if (!text.empty()) text += "  |  ";
  append(text, format, values...);
}

// Appends what the worker does and what a drag shows.
void append_state(std::string& text, const Editor& editor) {
  using At = PreparationStatus::Phase;
  const PreparationStatus status = editor.session().preparation().status();
  const double percent = 100.0 * status.fraction;
  switch (status.phase) {
    case At::previewing:
    case At::solving:
      append_part(text, "Preparing: %s %.0f%%", stage_in_words(status.stage).data(), percent);
      break;
    case At::settling:
      // During a drag the surface settles in every frame, so the text would flicker.
      if (!editor.tool().is_dragging()) append_part(text, "Refining %.0f%%", percent);
      break;
    case At::failed:
      append_part(text, "%s", "The edit cannot be prepared");
      break;
    case At::idle:
    case At::ready:
      break;
  }
  const WorkStatus step = editor.session().step_status();
  if (step.busy) {
    append_part(text, "Applying: %s %.0f%%", stage_in_words(step.stage).data(),
                100.0 * step.fraction);
  }
  if (editor.drag().shows_live_result()) {
    append_part(text, "%s", "Refined while dragging");
  } else if (editor.view().device().source() == SurfaceSource::preview) {
    append_part(text, "%s", "Rough preview");
  } else if (editor.view().device().source() == SurfaceSource::exact) {
    append_part(text, "%s", "Linear response");
  }
  if (editor.view().shown().shows_before()) append_part(text, "%s", "Original");
}

}  // namespace

float status_height() {
  return ImGui::GetFrameHeight();
}

void ViewerApp::draw_ui(const FrameTimings& last) {
  measure_panels();
  take_loaded();
  update_document();
  take_settled();
  take_recipe_check();
  record_turntable();
  carry_out_order();
  draw_menu();
  draw_status();
  if (document_) {
    draw_marks();
    if (show_panels_) draw_sidebar();
    draw_over_picture();
  }
  draw_dialogs();
  PictureArea free = picture_area();
  free.corner.y() += banner_height_;
  free.size.y() -= banner_height_ + guide_height_;
  draw_toasts(messages_, free);
  if (show_machine_) {
    const Certificate* certificate =
        document_ ? document_->editor.session().certificate() : nullptr;
    draw_machine_panel(context_->description(), last, certificate, show_machine_);
  }
  if (show_messages_) draw_messages_panel(messages_, show_messages_);
  if (document_) ++frames_shown_;
  keep_preferences();
}

double ViewerApp::pixels_per_unit() const {
  return std::max(1.0, size_.x() / static_cast<double>(ImGui::GetMainViewport()->Size.x));
}

// Returns the part of the picture that the panels leave free.
PictureArea ViewerApp::picture_area() const {
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const double left = sidebar_pixels() / pixels_per_unit();
  const Eigen::Vector2d corner(left + static_cast<double>(viewport.WorkPos.x),
                               static_cast<double>(viewport.WorkPos.y) + toolbar_height_);
  const Eigen::Vector2d end(
      static_cast<double>(viewport.WorkPos.x + viewport.WorkSize.x),
      static_cast<double>(viewport.WorkPos.y + viewport.WorkSize.y - status_height()));
  return {corner, (end - corner).cwiseMax(0.0)};
}

void ViewerApp::draw_marks() {
  const double per_unit = pixels_per_unit();
  marks_.draw(document_->editor, view_frame(), per_unit, cursor_);
  marks_.draw_transplant(document_->transplant, view_frame(), per_unit);
  if (const auto line = slider_line()) {
    marks_.draw_slider(view_frame(), per_unit, *line,
                       per_unit * (picture_area().corner.y() + banner_height_));
  }
  if (const auto center = axis_gizmo_center()) {
    draw_axis_gizmo(camera_, *center / per_unit, pixels_per_point_ / per_unit);
  }
  const auto area = source_area();
  if (!area) return;
  marks_.draw(document_->desk, document_->editor, view_frame(), area->corner, per_unit);
  marks_.draw_pane_names(document_->desk, document_->opened.name, picture_area(),
                         area->size.x() / per_unit);
}

void ViewerApp::draw_over_picture() {
  toolbar_height_ = guide_height_ = banner_height_ = 0.0;
  const bool edits = !document_->banner.is_empty() && !document_->banner.has_picture() &&
                     !document_->mesh_steps.has_picture();
  // Drawn also while the banner has the picture, so that the banner does not move under the cursor.
  if (show_panels_ && !document_->banner.is_empty()) {
    toolbar_height_ = draw_toolbar(document_->editor, picture_area());
  }
  const double gap = 0.5 * static_cast<double>(ImGui::GetFontSize());
  const PictureArea area = picture_area();
  const Eigen::Vector2d inside(gap, gap);
  const double taken = draw_banner(area.corner + inside, area.corner + area.size - inside);
  if (taken > 0.0) banner_height_ = taken + gap;
  if (!show_panels_ || !edits || !preferences_.shows_guide) return;
  const Guide guide = guide_of(document_->desk, document_->transplant, document_->editor);
  guide_height_ = draw_guide(guide, picture_area());
}

// Writes changed preferences once no mouse button is down.
void ViewerApp::keep_preferences() {
  if (document_) {
    Editor& editor = document_->editor;
    preferences_.settles_while_dragging = editor.drag().wants_to_settle();
    preferences_.grab_radius_pt = editor.tool().tools().grab.radius_pt();
    preferences_.brush_radius_pt = editor.tool().tools().paint.options().radius_pt;
    if (editor.tool().row() != nullptr && chooses(*editor.tool().row())) {
      preferences_.tool = editor.tool().row()->name;
    }
  }
  if (kept_.preferences.empty() || preferences_ == kept_preferences_ || ImGui::IsAnyMouseDown()) {
    return;
  }
  kept_preferences_ = preferences_;
  try {
    write_preferences(preferences_, kept_.preferences);
  } catch (const Error& error) {
    say({error.what(), Tone::warning});
    kept_.preferences.clear();  // so that it is said only once
  }
}

void ViewerApp::update_document() {
  if (!document_) return;
  Editor& editor = document_->editor;
  DetailTransferTool& desk = document_->desk;
  TransplantTool& transplant = document_->transplant;
  editor.update();
  // Both preview on the surface, so the one begun last closes the other.
  if (desk.is_open() && transplant.is_open()) {
    transplants_ ? transplant.close(editor) : desk.close(editor);
  }
  transplants_ = transplant.is_open();
  desk.update(editor);
  transplant.update(editor);
  const bool others = desk.is_open() || transplant.is_open();
  document_->banner.update(editor, others || document_->mesh_steps.is_open());
  document_->mesh_steps.update(editor, others);
  part_pictures_.renew(transplant.library(), *context_);
  const auto area = source_area();
  if (area) document_->desk.view()->resize(area->size, pixels_per_point_);
  camera_.target_across = covered_share();
  // The free part of the window has changed.
  if (std::exchange(shows_source_, area.has_value()) != area.has_value()) frame_all();
}

// Returns what is open and chosen, and what to do if no guide says it.
const std::string& ViewerApp::status_text() {
  std::string& text = status_line_;
  text.clear();
  if (const WorkStatus loading = loader_.status(); loading.busy) {
    text.append(loading_.file.filename().string())
        .append(": ")
        .append(stage_in_words(loading.stage));
    text.append(" (Escape cancels)");
    return text;
  }
  if (!document_) return text = "? shows the controls";
  const Editor& editor = document_->editor;
  append(text, "%zu vertices", editor.view().positions().size());
  if (const std::size_t chosen = editor.state().selection.roi.vertices.size(); chosen > 0) {
    append(text, "  |  Region %zu", chosen);
  }
  if (const std::size_t handles = editor.state().selection.handles.size(); handles > 0) {
    append(text, handles == 1 ? "  |  1 handle" : "  |  %zu handles", handles);
  }
  if (!preferences_.shows_guide) text.append("  |  ").append(editor.input().hint());
  return text;
}

void ViewerApp::draw_status() {
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(
      {viewport.WorkPos.x, viewport.WorkPos.y + viewport.WorkSize.y - status_height()});
  ImGui::SetNextWindowSize({viewport.WorkSize.x, status_height()});
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(style.WindowPadding.x, style.FramePadding.y));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
  if (ImGui::Begin("Status", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar)) {
    // The state changes its width with every frame. At the right end it moves no other word.
    std::string& state = state_line_;
    state.clear();
    if (document_) append_state(state, document_->editor);
    const float at =
        viewport.WorkSize.x - style.WindowPadding.x - ImGui::CalcTextSize(state.c_str()).x;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::PushClipRect(
        corner,
        {viewport.WorkPos.x + at - style.ItemSpacing.x, corner.y + ImGui::GetTextLineHeight()},
        true);
    ImGui::TextUnformatted(status_text().c_str());
    ImGui::PopClipRect();
    ImGui::SameLine(at);
    ImGui::TextUnformatted(state.c_str());
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace lapwing::viewer
