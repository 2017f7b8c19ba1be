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

// Returns whether the user closes it.
bool draw_toast(const Messages::Toast& toast) {
  bool closes = false;
  if (ImGui::BeginTable("toast", 2)) {
    ImGui::TableSetupColumn("text", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("Close", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    draw_colored(toast.message.tone, toast.message.text);
    if (toast.times > 1) ImGui::TextDisabled("%d times", toast.times);
    ImGui::TableNextColumn();
    closes = ImGui::SmallButton("Close");
    explain("All messages: Help > Messages.");
    ImGui::EndTable();
  }
  return closes;
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

void draw_toasts(Messages& messages, const PictureArea& area) {
  std::optional<std::size_t> closed;
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
    if (draw_toast(toast)) closed = k;
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
