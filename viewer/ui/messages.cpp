#include "ui/messages.h"

#include <algorithm>
#include <imgui.h>
#include <optional>
#include <utility>

#include "ui/panels.h"
#include "ui/widgets.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

constexpr std::size_t kLongestLog = 200;
// More would cover the picture; the log has all of them.
constexpr std::size_t kMostToasts = 4;
constexpr double kReadingSeconds = 4.0;

// In letters of the font.
constexpr float kToastLetters = 24.0F;
constexpr float kLogLetters = 40.0F;
constexpr float kLogLines = 20.0F;

Message in_words(Message message) {
  message.text = in_window_words(std::move(message.text));
  return message;
}

// Returns whether a panel can open the step again.
bool can_edit(const Step& step) {
  return std::holds_alternative<CoatStep>(step) || std::holds_alternative<MixStep>(step) ||
         std::holds_alternative<TransplantStep>(step);
}

// What the user does with a message.
enum class ToastChoice { none, close, edit_step };

ToastChoice draw_toast(const Messages::Toast& toast, bool has_step) {
  ToastChoice choice = ToastChoice::none;
  if (ImGui::BeginTable("toast", 2)) {
    ImGui::TableSetupColumn("text", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("Close", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    draw_colored(toast.message.tone, toast.message.text);
    if (toast.times > 1) ImGui::TextDisabled("%d times", toast.times);
    ImGui::TableNextColumn();
    if (ImGui::SmallButton("Close")) choice = ToastChoice::close;
    explain("Closes the message. Help > Messages lists all messages.");
    if (has_step) {
      if (ImGui::SmallButton("Edit step")) choice = ToastChoice::edit_step;
      explain("Edits this step again. When you apply it, the steps after it run again.");
    }
    ImGui::EndTable();
  }
  return choice;
}

// The upper right corner of the picture, or the lower left one.
enum class Corner { upper, lower };

void begin_over_picture(const char* name, const PictureArea& area, Corner where,
                        ImGuiWindowFlags more) {
  constexpr ImGuiWindowFlags kOverPicture =
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
      ImGuiWindowFlags_AlwaysAutoResize;
  const float gap = 0.5F * ImGui::GetFontSize();
  const Eigen::Vector2f corner = area.corner.cast<float>();
  const Eigen::Vector2f opposite = (area.corner + area.size).cast<float>();
  const float room = opposite.x() - corner.x() - 2.0F * gap;
  const float width = std::min(kToastLetters * ImGui::GetFontSize(), room);
  if (where == Corner::upper) {
    ImGui::SetNextWindowPos({opposite.x() - gap, corner.y() + gap}, ImGuiCond_Always, {1.0F, 0.0F});
    ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, 1e6F});
  } else {
    ImGui::SetNextWindowPos({corner.x() + gap, opposite.y() - gap}, ImGuiCond_Always, {0.0F, 1.0F});
    ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, {width, 1e6F});
  }
  ImGui::Begin(name, nullptr, kOverPicture | more);
}

}  // namespace

void Messages::remove(Tone tone) {
  std::erase_if(toasts_, [tone](const Toast& toast) { return toast.message.tone == tone; });
}

void Messages::say(Message message, double now) {
  if (message.text.empty()) return remove(message.tone);
  message = in_words(std::move(message));
  if (!toasts_.empty() && toasts_.back().message == message) {
    toasts_.back().since = now;
    ++toasts_.back().times;
  } else {
    if (message.tone == Tone::note) remove(Tone::note);
    if (toasts_.size() == kMostToasts) toasts_.erase(toasts_.begin());
    toasts_.push_back({message, now, 1});
  }
  log(std::move(message));
}

void Messages::record(Message message) {
  log(in_words(std::move(message)));
}

void Messages::log(Message message) {
  if (log_.size() == kLongestLog) log_.erase(log_.begin());
  log_.push_back(std::move(message));
}

void Messages::acted(double now) {
  std::erase_if(toasts_, [now](const Toast& toast) {
    return toast.message.tone == Tone::note && now - toast.since >= kReadingSeconds;
  });
}

void Messages::close(std::size_t toast) {
  if (toast < toasts_.size()) toasts_.erase(toasts_.begin() + static_cast<std::ptrdiff_t>(toast));
}

std::optional<std::size_t> draw_toasts(Messages& messages, const PictureArea& area,
                                       std::span<const std::shared_ptr<const Step>> steps) {
  std::optional<std::size_t> closed;
  std::optional<std::size_t> edited;
  const Message* note = nullptr;
  bool is_begun = false;
  for (std::size_t k = messages.toasts().size(); k-- > 0;) {
    const Messages::Toast& toast = messages.toasts()[k];
    if (toast.message.tone == Tone::note) {
      note = &toast.message;
      continue;
    }
    if (!is_begun) begin_over_picture("Toasts", area, Corner::upper, ImGuiWindowFlags_None);
    if (is_begun) ImGui::Separator();
    is_begun = true;
    ImGui::PushID(static_cast<int>(k));
    // The step may have been undone or replaced since.
    const auto step = std::ranges::find(steps, toast.message.step);
    const bool has_step = step != steps.end() && can_edit(**step);
    const ToastChoice choice = draw_toast(toast, has_step);
    if (choice != ToastChoice::none) closed = k;
    if (choice == ToastChoice::edit_step) edited = step - steps.begin();
    ImGui::PopID();
  }
  if (is_begun) ImGui::End();
  // A note disappears by itself and lets the mouse through.
  if (note != nullptr) {
    begin_over_picture("Note", area, Corner::lower, ImGuiWindowFlags_NoInputs);
    ImGui::PushTextWrapPos(kToastLetters * ImGui::GetFontSize() -
                           2.0F * ImGui::GetStyle().WindowPadding.x);
    ImGui::TextUnformatted(note->text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::End();
  }
  if (closed) messages.close(*closed);
  return edited;
}

void draw_messages_panel(const Messages& messages, bool& open) {
  center_next_window(ImGuiCond_Appearing);
  ImGui::SetNextWindowSize(
      {kLogLetters * ImGui::GetFontSize(), kLogLines * ImGui::GetTextLineHeightWithSpacing()},
      ImGuiCond_Appearing);
  if (ImGui::Begin("Messages", &open, ImGuiWindowFlags_NoCollapse)) {
    for (const Message& message : messages.log()) draw_colored(message.tone, message.text);
    if (messages.log().empty()) ImGui::TextDisabled("No messages.");
    if (ImGui::IsWindowAppearing()) ImGui::SetScrollHereY(1.0F);
  }
  ImGui::End();
}

}  // namespace lapwing::viewer
