#include "ui/sidebar.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <iterator>
#include <utility>

#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

constexpr auto kOpen = ImGuiTreeNodeFlags_DefaultOpen;

// In letters of the font.
constexpr float kGripLetters = 0.4F;
constexpr float kResultLines = 8.0F;
constexpr float kHistoryLines = 5.0F;
// Largest share of the height. On a low window the tabs keep the greater part.
constexpr float kMostOfHeight = 0.27F;
// The width that the choices of the Display tab need, in letters.
constexpr double kLeastLetters = 26.0;

struct Tab {
  const char* name;
  Task task;
};
constexpr Tab kTabs[]{{"Deform", Task::deform},
                      {"Coat", Task::coat},
                      {"Mix", Task::mix},
                      {"Wrap", Task::wrap},
                      {"Transplant", Task::transplant},
                      {"Mesh", Task::mesh},
                      {"Display", Task::display}};

// Returns the width of all tabs without the padding beside their names.
float bare_width_of_tabs() {
  float width = 0.0F;
  for (const Tab& tab : kTabs) {
    width += ImGui::CalcTextSize(tab.name).x + ImGui::GetStyle().ItemInnerSpacing.x + 1.0F;
  }
  return width;
}

// Returns the smallest width of the sidebar, in letters of the font, at which the tabs have a third
// of their usual padding. A wider sidebar would leave too little room for the tools.
double least_letters() {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float width = 2.0F * style.WindowPadding.x + bare_width_of_tabs() +
                      2.0F / 3.0F * style.FramePadding.x * static_cast<float>(std::size(kTabs));
  return std::max(kLeastLetters, std::ceil(static_cast<double>(width / ImGui::GetFontSize())));
}

// Returns the padding beside a tab's name. In a small window it is narrow, so that no name is cut
// off.
float padding_of_tabs() {
  const float free = ImGui::GetContentRegionAvail().x - bare_width_of_tabs();
  const float share = std::floor(0.5F * free / static_cast<float>(std::size(kTabs)));
  return std::clamp(share, 0.0F, ImGui::GetStyle().FramePadding.x);
}

float height_of_lines(float lines, float most) {
  return std::min(lines * ImGui::GetTextLineHeightWithSpacing(), most);
}

}  // namespace

void Sidebar::measure() {
  viewport_.panels.sidebar = std::max(preferences_.sidebar_letters, least_letters()) *
                             static_cast<double>(ImGui::GetFontSize());
  // Menu and tools are not there yet in the first frame.
  const double row = static_cast<double>(ImGui::GetFrameHeight());
  const double menu = static_cast<double>(ImGui::GetMainViewport()->WorkPos.y);
  const double one_row = row + 2.0 * static_cast<double>(ImGui::GetStyle().FramePadding.y);
  viewport_.panels.covered_top = std::max(menu, row) + std::max(viewport_.panels.toolbar, one_row);
}

void Sidebar::update(gpu::Context& context) {
  part_pictures_.renew(document_->transplant.library(), context);
}

// Draws the edge by which the user resizes the sidebar.
void Sidebar::draw_edge(float right, float top, float height) {
  const float grip = kGripLetters * ImGui::GetFontSize();
  ImGui::SetNextWindowPos({right - grip, top});
  ImGui::SetNextWindowSize({grip, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
  if (ImGui::Begin("Edge", nullptr,
                   (kFixed | kWithoutScrolling) & ~ImGuiWindowFlags_NoBringToFrontOnFocus)) {
    ImGui::InvisibleButton("edge", {grip, height});
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
      ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
      ImGui::GetWindowDrawList()->AddRectFilled({right - 0.5F * grip, top}, {right, top + height},
                                                ImGui::GetColorU32(ImGuiCol_SeparatorHovered));
    }
    if (ImGui::IsItemActive()) {
      const double letters = static_cast<double>(ImGui::GetIO().MousePos.x / ImGui::GetFontSize());
      const double most = kMostOfSidebar * static_cast<double>(ImGui::GetMainViewport()->Size.x /
                                                               ImGui::GetFontSize());
      preferences_.sidebar_letters = std::clamp(letters, std::min(least_letters(), most), most);
    }
  }
  ImGui::End();
  ImGui::PopStyleVar(3);
}

// Brings a task to the front that a key or a menu has begun.
void Sidebar::follow_task() {
  const DetailTransferTool& desk = document_->desk;
  const Task begun = document_->transplant.is_open()                         ? Task::transplant
                     : document_->wrap.is_open()                             ? Task::wrap
                     : !desk.is_open()                                       ? Task::deform
                     : desk.draft().operation == LayerDraft::Operation::coat ? Task::coat
                                                                             : Task::mix;
  if (std::exchange(begun_task_, begun) == begun || begun == Task::deform) return;
  task_to_show_ = begun;
}

void Sidebar::draw_tabs() {
  follow_task();
  const ImVec2 padding{padding_of_tabs(), ImGui::GetStyle().FramePadding.y};
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, padding);
  const bool is_drawn = ImGui::BeginTabBar("tasks");
  ImGui::PopStyleVar();
  if (!is_drawn) return;
  for (const Tab& tab : kTabs) {
    const bool wanted = task_to_show_ == tab.task;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, padding);
    const bool is_open =
        ImGui::BeginTabItem(tab.name, nullptr, wanted ? ImGuiTabItemFlags_SetSelected : 0);
    ImGui::PopStyleVar();
    if (!is_open) continue;
    ImGui::BeginChild(tab.name);
    draw_task(tab.task);
    ImGui::EndChild();
    ImGui::EndTabItem();
  }
  task_to_show_.reset();
  ImGui::EndTabBar();
}

void Sidebar::draw_task(Task task) {
  Editor& editor = document_->editor;
  switch (task) {
    case Task::deform:
      if (ImGui::CollapsingHeader("Selection", kOpen))
        draw_selection_panel(editor, drafts_, preferences_.unit);
      if (ImGui::CollapsingHeader("Move", kOpen))
        draw_deform_panel(editor, drafts_, preferences_.unit);
      break;
    case Task::coat:
    case Task::mix:
      if (const auto purpose = draw_layer_panel(document_->desk, editor, task, preferences_.unit)) {
        wish_.path = purpose;
      }
      break;
    case Task::wrap:
      take(draw_wrap_panel(document_->wrap, editor, display_.style));
      break;
    case Task::transplant:
      if (const auto purpose =
              draw_transplant_panel(document_->transplant, part_pictures_, editor, drafts_)) {
        wish_.path = purpose;
      }
      break;
    case Task::mesh:
      draw_mesh_panel(*document_, preferences_.unit);
      draw_mesh_commands();
      if (!editor.state().carried.empty()) ImGui::SetNextItemOpen(true, ImGuiCond_Once);
      if (ImGui::CollapsingHeader("Attached objects")) {
        if (const auto wanted = draw_carried_panel(editor)) wish_.action = wanted;
      }
      break;
    case Task::display:
      draw_display_panel(display_, editor);
      if (ImGui::CollapsingHeader("Preferences", kOpen)) {
        draw_preferences_panel(preferences_);
      }
      break;
  }
}

void Sidebar::take(const WrapWish& wish) {
  if (wish.path) wish_.path = wish.path;
  if (!wish.coat.empty()) document_->coat_detail(wish.coat);
}

void Sidebar::draw_mesh_commands() {
  if (document_->has_open_task()) {
    ImGui::TextDisabled("Apply or cancel the open operation before you change the triangles.");
    return;
  }
  const double size = document_->report.statistics.bounds.diagonal();
  const auto hole = draw_mesh_steps(document_->mesh_steps, document_->editor, size);
  if (hole) viewport_.show_vertices(*hole);
}

// Draws the result of what is open, always in the same place.
void Sidebar::draw_result() {
  Editor& editor = document_->editor;
  if (document_->desk.is_open()) return draw_layer_result(document_->desk, editor);
  if (document_->transplant.is_open()) {
    return draw_transplant_result(document_->transplant, editor);
  }
  if (document_->wrap.is_open()) {
    return take(draw_wrap_result(document_->wrap, editor));
  }
  if (document_->mesh_steps.is_open()) return draw_mesh_step_result(document_->mesh_steps, editor);
  const ResultWish wish = draw_result_panel(editor, viewport_.shows_vertices());
  if (wish.back) viewport_.look_back();
  if (wish.show) viewport_.show_vertices(*wish.show);
}

Sidebar::Wish Sidebar::draw() {
  wish_ = {};
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const float width = static_cast<float>(viewport_.sidebar_width());
  const float height = viewport.WorkSize.y - status_height();
  ImGui::SetNextWindowPos(viewport.WorkPos);
  ImGui::SetNextWindowSize({width, height});
  if (ImGui::Begin("Panels", nullptr, kFixed | kWithoutScrolling)) {
    const float most = kMostOfHeight * height;
    const float result = height_of_lines(kResultLines, most);
    const float history = height_of_lines(kHistoryLines, most) + ImGui::GetFrameHeightWithSpacing();
    const float between = 2.0F * ImGui::GetStyle().ItemSpacing.y + 1.0F;
    ImGui::BeginChild("task", {0.0F, -(result + history + 2.0F * between)}, false,
                      kWithoutScrolling);
    draw_tabs();
    ImGui::EndChild();
    ImGui::Separator();
    ImGui::BeginChild("result", {0.0F, result});
    draw_result();
    ImGui::EndChild();
    ImGui::Separator();
    if (const auto purpose = draw_history_panel(document_->editor, drafts_)) wish_.path = purpose;
  }
  ImGui::End();
  draw_edge(viewport.WorkPos.x + width, viewport.WorkPos.y, height);
  return wish_;
}

}  // namespace lapwing::viewer
