// The parts of a frame other than menu and sidebar.

#include <algorithm>
#include <array>
#include <cstdio>
#include <imgui.h>
#include <utility>

#include "lapwing/base/errors.h"
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
  sidebar_.measure();
  files_.take_loaded();
  update_document();
  files_.take_settled();
  recorder_.update();
  carry_out_order();
  draw_menu();
  draw_status();
  if (document_) {
    viewport_.draw_marks();
    if (viewport_.panels.are_shown) draw_sidebar();
    draw_over_picture();
  }
  draw_dialogs();
  PictureArea free = viewport_.free_area();
  free.corner.y() += viewport_.panels.banner;
  free.size.y() -= viewport_.panels.banner + viewport_.panels.guide;
  std::span<const std::shared_ptr<const Step>> steps;
  if (document_) steps = document_->editor.state().steps;
  if (const auto step = draw_toasts(messages_, free, steps)) document_->edit_step(*step);
  if (show_machine_) {
    const Certificate* certificate =
        document_ ? document_->editor.session().certificate() : nullptr;
    draw_machine_panel(context_->description(), last, certificate, show_machine_);
  }
  if (show_messages_) draw_messages_panel(messages_, show_messages_);
  if (document_) ++frames_shown_;
  keep_preferences();
}

void ViewerApp::draw_sidebar() {
  const Sidebar::Wish wish = sidebar_.draw();
  if (wish.path) dialogs_.ask_for(*wish.path);
  if (wish.action) perform(*wish.action);
}

void ViewerApp::carry_out_order() {
  // The first frame has been shown when the second one is laid out.
  if (!order_ || !document_ || frames_shown_ < 1) return;
  const Eigen::Vector2d& size = viewport_.camera().size();
  const VkExtent2D window{static_cast<std::uint32_t>(size.x()),
                          static_cast<std::uint32_t>(size.y())};
  recorder_.save_picture(order_->path, order_->size.value_or(window));
  document_->editor.session().close();
  quit_ = true;
}

void ViewerApp::draw_dialogs() {
  files_.draw_start();
  recorder_.draw_plans();
  if (const auto chosen = dialogs_.draw(); chosen && !recorder_.use(*chosen)) files_.use(*chosen);
  files_.draw_unsaved();
  recorder_.draw_progress();
  if (show_controls_) draw_controls_list(keymap_named(preferences_.mouse), show_controls_);
}

void ViewerApp::draw_over_picture() {
  PanelSizes& panels = viewport_.panels;
  panels.toolbar = panels.guide = panels.banner = 0.0;
  const bool edits = !document_->banner.is_empty() && !document_->banner.has_picture() &&
                     !document_->mesh_steps.has_picture();
  // Drawn also while the banner has the picture, so that the banner does not move under the cursor.
  if (panels.are_shown && !document_->banner.is_empty()) {
    panels.toolbar = draw_toolbar(document_->editor, viewport_.free_area());
  }
  const double gap = 0.5 * static_cast<double>(ImGui::GetFontSize());
  const PictureArea area = viewport_.free_area();
  const Eigen::Vector2d inside(gap, gap);
  const double taken = draw_banner(area.corner + inside, area.corner + area.size - inside);
  if (taken > 0.0) panels.banner = taken + gap;
  if (!panels.are_shown || !edits || !preferences_.shows_guide) return;
  const Guide guide =
      guide_of(document_->desk, document_->transplant, document_->wrap, document_->editor);
  panels.guide = draw_guide(guide, viewport_.free_area());
}

double ViewerApp::draw_banner(const Eigen::Vector2d& corner, const Eigen::Vector2d& end) {
  if (document_->has_open_task() && !document_->banner.is_empty()) return 0.0;
  DoctorBanner& banner = document_->banner;
  const bool had_picture = banner.has_picture();
  const auto wish = banner.draw(document_->editor, corner, end - corner);
  if (!had_picture && banner.has_picture()) document_->mesh_steps.give_way();
  if (!wish) return banner.height();
  switch (*wish) {
    case BannerWish::look_at_places:
      viewport_.look_at_places();
      break;
    case BannerWish::look_back:
      viewport_.look_back_from_places();
      break;
    case BannerWish::keep_repair:
      dialogs_.ask_for(PathPurpose::save_repaired);
      break;
    case BannerWish::open_another:
      dialogs_.ask_for(PathPurpose::open);
      break;
  }
  return banner.height();
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
  if (preferences_file_.empty() || preferences_ == kept_preferences_ || ImGui::IsAnyMouseDown()) {
    return;
  }
  kept_preferences_ = preferences_;
  try {
    write_preferences(preferences_, preferences_file_);
  } catch (const Error& error) {
    say({error.what(), Tone::warning});
    preferences_file_.clear();  // so that it is reported only once
  }
}

void ViewerApp::update_document() {
  if (!document_) return;
  Editor& editor = document_->editor;
  DetailTransferTool& desk = document_->desk;
  TransplantTool& transplant = document_->transplant;
  WrapTool& wrap = document_->wrap;
  editor.update();
  // Each of them shows its preview on the surface, so the one that begins closes the others.
  if (desk.is_open() + transplant.is_open() + wrap.is_open() > 1) {
    if (was_open_[0]) desk.close(editor);
    if (was_open_[1]) transplant.close(editor);
    if (was_open_[2]) wrap.close(editor);
  }
  was_open_ = {desk.is_open(), transplant.is_open(), wrap.is_open()};
  desk.update(editor);
  transplant.update(editor);
  wrap.update(editor);
  const bool others = document_->has_open_task();
  document_->banner.update(editor, others || document_->mesh_steps.is_open());
  document_->mesh_steps.update(editor, others);
  sidebar_.update(*context_);
  viewport_.update();
}

// Returns what is open and chosen, and what to do if no guide says it.
const std::string& ViewerApp::status_text() {
  std::string& text = status_line_;
  text.clear();
  if (files_.append_status(text)) return text;
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
