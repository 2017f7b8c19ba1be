// The dialogs that save a picture or a turntable.

#include <algorithm>
#include <array>
#include <cstdio>
#include <imgui.h>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

constexpr int kMostPictures = 9999;
constexpr double kMostPerSecond = 120.0;
constexpr float kFieldLetters = 9.0F;
constexpr float kLabelLetters = 9.0F;
constexpr float kProgressLetters = 24.0F;

// Writes a label and gives the next item, on the same line, the width of a number.
void label_number(const char* label) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  ImGui::SameLine(kLabelLetters * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(kFieldLetters * ImGui::GetFontSize());
}

bool begin_dialog(const char* title, bool& open) {
  center_next_window(ImGuiCond_Appearing);
  return ImGui::Begin(title, &open,
                      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
}

void ask_for_size(PicturePlan& plan) {
  std::array<int, 2> size{plan.width, plan.height};
  label_number("Resolution");
  if (!ImGui::InputInt2("##pixels", size.data())) return;
  plan.width = std::max(1, size[0]);
  plan.height = std::max(1, size[1]);
}

// Returns whether the button or Enter accepts the plan. Then the dialog closes.
bool is_accepted(PicturePlan& plan) {
  const bool enters = !ImGui::IsAnyItemActive() && is_pressed(ImGuiKey_Enter);
  const bool accepted = ImGui::Button("Save as...") || enters;
  if (accepted) plan.open = false;
  return accepted;
}

// Returns true if the user cancels.
bool draw_progress(const TurntableRecording& recording) {
  const TurntableRecording::Order& order = recording.order();
  const int written = recording.written();
  ImGui::TextUnformatted(order.output.filename().c_str());
  std::array<char, 64> words{};
  std::snprintf(words.data(), words.size(), "%d of %d frames", written, order.count);
  ImGui::ProgressBar(static_cast<float>(written) / static_cast<float>(order.count),
                     {kProgressLetters * ImGui::GetFontSize(), 0.0F}, words.data());
  return ImGui::Button("Cancel");
}

}  // namespace

bool draw_picture_panel(PicturePlan& plan) {
  bool save = false;
  if (begin_dialog("Save image", plan.open)) {
    ask_for_size(plan);
    save = is_accepted(plan);
  }
  ImGui::End();
  return save;
}

bool draw_turntable_panel(TurntablePlan& plan) {
  bool save = false;
  if (begin_dialog("Save turntable", plan.picture.open)) {
    ImGui::TextUnformatted("The camera orbits once around the up axis.");
    label_number("Frames");
    if (ImGui::InputInt("##pictures", &plan.count)) {
      plan.count = std::clamp(plan.count, 1, kMostPictures);
    }
    label_number("Frame rate (video)");
    if (ImGui::InputDouble("##rate", &plan.per_second, 1.0, 0.0, "%.4g")) {
      plan.per_second = std::clamp(plan.per_second, 1.0, kMostPerSecond);
    }
    ask_for_size(plan.picture);
    ImGui::TextDisabled("Duration: %.3g s", plan.count / plan.per_second);
    save = is_accepted(plan.picture);
  }
  ImGui::End();
  return save;
}

bool draw_turntable_progress(const TurntableRecording* recording) {
  constexpr const char* kTitle = "Saving turntable";
  const bool is_shown = ImGui::IsPopupOpen(kTitle);
  if (recording == nullptr && !is_shown) return false;
  if (!is_shown) ImGui::OpenPopup(kTitle);
  center_next_window();
  bool give_up = false;
  if (ImGui::BeginPopupModal(kTitle, nullptr, kDialog)) {
    if (recording == nullptr) {
      ImGui::CloseCurrentPopup();
    } else {
      give_up = draw_progress(*recording);
    }
    ImGui::EndPopup();
  }
  return give_up;
}

}  // namespace lapwing::viewer
