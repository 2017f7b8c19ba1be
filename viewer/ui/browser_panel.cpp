#include "ui/browser_panel.h"

#include <algorithm>
#include <array>
#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>
#include <utility>

#include "files/path_text.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;
using Wants = PathWords::Wants;

// In letters of the font.
const ImVec2 kBrowserLetters{56.0F, 36.0F};
constexpr float kPlaceLetters = 11.0F;
constexpr float kSizeLetters = 5.0F;
constexpr float kDateLetters = 9.0F;

void append_utf8(std::string& text, char32_t letter) {
  std::array<char, 5> bytes{};
  ImTextCharToUtf8(bytes.data(), static_cast<unsigned int>(letter));
  text += bytes.data();
}

void remove_last_letter(std::string& text) {
  const auto is_inside = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  while (!text.empty() && is_inside(text.back())) text.pop_back();
  if (!text.empty()) text.pop_back();
}

// Returns the folders from the root down to `folder`.
std::vector<fs::path> way_to(const fs::path& folder) {
  std::vector<fs::path> way;
  fs::path path;
  for (const fs::path& name : folder) {
    path /= name;
    way.push_back(path);
  }
  return way;
}

std::string name_of_step(const fs::path& folder) {
  return folder.has_filename() ? folder.filename().string() : folder.string();
}

// Returns a label such as "Meshes (*.obj, *.off, ...)".
std::string in_words(const FileKind& kind) {
  constexpr std::size_t kMost = 4;
  std::string text(kind.name);
  for (std::size_t k = 0; k < kind.extensions.size() && k <= kMost; ++k) {
    text += k == 0 ? " (" : ", ";
    text += k == kMost ? "..." : "*" + std::string(kind.extensions[k]);
  }
  return kind.extensions.empty() ? text : text + ")";
}

}  // namespace

BrowserPanel::BrowserPanel(std::function<void()> wake)
    : reader_([] { return std::make_unique<CpuKernels>(); }, std::move(wake)) {}

void BrowserPanel::open(PathRequest request, std::string trouble) {
  request_ = std::move(request);
  typed_ = request_->name;
  trouble_ = std::move(trouble);
  kind_ = 0;
  enter_pressed_ = false;
  has_focus_ = false;
  show(request_->folder);
  // A refused name is to be corrected, a suggested one to be replaced.
  is_suggestion_ = trouble_.empty();
  focus(!is_suggestion_);
}

void BrowserPanel::say(std::string trouble) {
  trouble_ = std::move(trouble);
  is_suggestion_ = false;
  focus(true);
}

void BrowserPanel::focus(bool at_end) {
  asks_for_focus_ = true;
  cursor_to_end_ = at_end;
}

void BrowserPanel::show(fs::path folder) {
  folder_ = std::move(folder);
  scrolls_to_top_ = true;
  list();
}

void BrowserPanel::list() {
  const PathWords& words = words_of(request_->purpose);
  ListingFilter filter;
  if (!words.kinds.empty()) filter.kind = words.kinds[kind_];
  filter.shows_hidden = shows_hidden_;
  filter.folders_only = words.wants == Wants::folder;
  reader_.start([folder = folder_, filter](const std::shared_ptr<Kernels>&, const Progress&) {
    return list_folder(folder, filter);
  });
}

void BrowserPanel::take(const InputEvent& event) {
  if (has_focus_) return;
  const bool is_text = event.kind == InputKind::text;
  const bool removes = event.kind == InputKind::key && event.key == kBackspace;
  if (is_text || removes) {
    if (std::exchange(is_suggestion_, false)) typed_.clear();
    if (is_text) append_utf8(typed_, event.text);
    if (removes) remove_last_letter(typed_);
    focus(true);
  }
  if (event.kind == InputKind::key && event.key == kTab) complete();
  if (event.kind == InputKind::key && event.key == kEnter) enter_pressed_ = true;
}

void BrowserPanel::complete() {
  typed_ = completed(typed_, folder_);
  is_suggestion_ = false;
  focus(true);
}

std::optional<fs::path> BrowserPanel::accept() {
  const Wants wants = words_of(request_->purpose).wants;
  trouble_.clear();
  if (typed_.empty()) {
    if (wants == Wants::folder) return folder_;
    trouble_ = "Choose a file from the list, or type a name.";
    return {};
  }
  fs::path path = path_of(typed_, folder_);
  std::error_code error;
  if (wants == Wants::folder || !fs::is_directory(path, error)) return path;
  // Enter a folder.
  typed_.clear();
  show(std::move(path));
  focus(true);
  return {};
}

std::optional<fs::path> BrowserPanel::draw() {
  if (!request_) return {};
  if (auto listing = reader_.take()) listing_ = *std::move(listing);
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const float letter = ImGui::GetFontSize();
  const ImVec2 size(std::min(kBrowserLetters.x * letter, viewport.WorkSize.x - letter),
                    std::min(kBrowserLetters.y * letter, viewport.WorkSize.y - letter));
  ImGui::SetNextWindowSize(size, ImGuiCond_Appearing);
  center_next_window(ImGuiCond_Appearing);
  // ImGui identifies the window by the name after ###, so the title may change.
  const std::string title = std::string(words_of(request_->purpose).title) + "###browser";
  bool open = true;
  std::optional<fs::path> chosen;
  constexpr auto kFlags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                          ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
  if (ImGui::Begin(title.c_str(), &open, kFlags)) {
    // The key that closed another dialog or opened this one is no answer here.
    const bool escapes =
        is_pressed(ImGuiKey_Escape) && !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    chosen = draw_inside();
    if (escapes) open = false;
  }
  ImGui::End();
  if (!open) close();
  return open ? chosen : std::nullopt;
}

std::optional<fs::path> BrowserPanel::draw_inside() {
  const PathWords& words = words_of(request_->purpose);
  ImGui::TextDisabled("%.*s", static_cast<int>(words.note.size()), words.note.data());
  draw_way();
  const float spacing = ImGui::GetStyle().ItemSpacing.y;
  const float width = ImGui::GetContentRegionAvail().x;
  const float said = trouble_.empty()
                         ? 0.0F
                         : ImGui::CalcTextSize(trouble_.c_str(), nullptr, false, width).y + spacing;
  const float below = 2.0F * ImGui::GetFrameHeightWithSpacing() + said + spacing;
  ImGui::BeginChild("places", {kPlaceLetters * ImGui::GetFontSize(), -below});
  std::optional<fs::path> chosen = draw_places();
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("files", {0.0F, -below});
  bool accepts = draw_list();
  ImGui::EndChild();
  accepts = draw_field() || accepts;
  if (!trouble_.empty()) draw_colored(Tone::error, trouble_);
  draw_filter();
  const std::string button(words.button);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - button_width(button.c_str()) -
                  button_width("Cancel") - ImGui::GetStyle().ItemSpacing.x);
  const bool cancels = ImGui::Button("Cancel");
  ImGui::SameLine();
  accepts = ImGui::Button(button.c_str()) || std::exchange(enter_pressed_, false) || accepts;
  if (cancels) {
    close();
    return {};
  }
  return accepts ? accept() : chosen;
}

// Draws Up and the folders of the path as buttons; only the last ones if there is not enough room.
void BrowserPanel::draw_way() {
  const std::vector<fs::path> way = way_to(folder_);
  std::optional<fs::path> wanted;
  if (ImGui::Button("Up") && folder_.has_parent_path()) wanted = folder_.parent_path();
  const ImGuiStyle& style = ImGui::GetStyle();
  const auto width_of = [&](const fs::path& step) {
    return button_width(name_of_step(step).c_str()) + style.ItemInnerSpacing.x;
  };
  float left = ImGui::GetContentRegionAvail().x - width_of("Up") - style.ItemSpacing.x;
  std::size_t first = way.size();
  while (first > 0 && (left -= width_of(way[first - 1])) > 0.0F) --first;
  // Show at least the folder itself.
  first = std::min(first, way.empty() ? 0 : way.size() - 1);
  for (std::size_t k = first; k < way.size(); ++k) {
    ImGui::SameLine(0.0F, k == first ? style.ItemSpacing.x : style.ItemInnerSpacing.x);
    ImGui::PushID(static_cast<int>(k));
    if (ImGui::Button(name_of_step(way[k]).c_str())) wanted = way[k];
    ImGui::PopID();
  }
  if (!wanted) return;
  show(*std::move(wanted));
  focus(false);
}

std::optional<fs::path> BrowserPanel::draw_places() {
  std::optional<fs::path> chosen;
  bool after_folders = false;
  for (std::size_t k = 0; k < request_->places.size(); ++k) {
    const BrowserPlace& place = request_->places[k];
    if (place.is_file && !std::exchange(after_folders, true)) {
      ImGui::Spacing();
      ImGui::TextDisabled("Recent");
    }
    ImGui::PushID(static_cast<int>(k));
    const bool is_here = !place.is_file && place.path == folder_;
    if (ImGui::Selectable(place.label.c_str(), is_here)) {
      if (place.is_file) {
        // As if it had been typed, so that it stays in the field after an error.
        typed_ = place.path.string();
        chosen = place.path;
      } else {
        show(place.path);
        focus(false);
      }
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", with_tilde(place.path).c_str());
    ImGui::PopID();
  }
  return chosen;
}

// Returns true if a file was double-clicked. Its name is then in the field.
bool BrowserPanel::draw_list() {
  const bool is_of_folder = listing_.folder == folder_;
  if (is_of_folder && !listing_.trouble.empty()) {
    ImGui::TextWrapped("%s", listing_.trouble.c_str());
    return false;
  }
  if (!is_of_folder || listing_.entries.empty()) {
    const bool reads = !is_of_folder || reader_.status().busy;
    ImGui::TextDisabled("%s", reads ? "Reading the folder..." : "No matching files.");
    return false;
  }
  bool accepts = false;
  if (!ImGui::BeginTable("entries", 3, ImGuiTableFlags_ScrollY)) return false;
  const float letter = ImGui::GetFontSize();
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Name", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("Size", ImGuiTableColumnFlags_WidthFixed, kSizeLetters * letter);
  ImGui::TableSetupColumn("Modified", ImGuiTableColumnFlags_WidthFixed, kDateLetters * letter);
  ImGui::TableHeadersRow();
  if (std::exchange(scrolls_to_top_, false)) ImGui::SetScrollY(0.0F);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(listing_.entries.size()));
  // Entering a folder replaces the list, so it waits for the end of the loop.
  std::optional<fs::path> entered;
  while (clipper.Step()) {
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
      const FolderEntry& entry = listing_.entries[static_cast<std::size_t>(row)];
      if (!draw_entry(entry)) continue;
      if (entry.is_folder) {
        entered = folder_ / entry.name;
      } else {
        accepts = true;
      }
    }
  }
  ImGui::EndTable();
  if (entered) {
    if (words_of(request_->purpose).wants != Wants::new_file) typed_.clear();
    show(*std::move(entered));
    focus(false);
  }
  return accepts;
}

// Returns true if the entry was double-clicked. A click on a file puts its name into the field.
bool BrowserPanel::draw_entry(const FolderEntry& entry) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const std::string label = entry.is_folder ? entry.name + "/" : entry.name;
  bool opens = false;
  constexpr auto kRow = ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick;
  if (ImGui::Selectable(label.c_str(), typed_ == entry.name, kRow)) {
    opens = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    const bool fits = !entry.is_folder || words_of(request_->purpose).wants == Wants::folder;
    if (fits) {
      typed_ = entry.name;
      is_suggestion_ = false;
    }
  }
  ImGui::TableNextColumn();
  if (!entry.is_folder) ImGui::TextDisabled("%s", size_in_words(entry.bytes).c_str());
  ImGui::TableNextColumn();
  if (entry.modified != fs::file_time_type()) {
    ImGui::TextDisabled("%s", date_in_words(entry.modified).c_str());
  }
  return opens;
}

int BrowserPanel::on_field(ImGuiInputTextCallbackData* data) {
  BrowserPanel& panel = *static_cast<BrowserPanel*>(data->UserData);
  if (data->EventFlag == ImGuiInputTextFlags_CallbackCompletion) {
    const std::string whole =
        completed({data->Buf, static_cast<std::size_t>(data->BufTextLen)}, panel.folder_);
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, whole.c_str());
    panel.cursor_to_end_ = true;
  }
  if (std::exchange(panel.cursor_to_end_, false)) {
    data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
  }
  return 0;
}

// Returns true if Enter was pressed in the field.
bool BrowserPanel::draw_field() {
  // Until the field has the keyboard, letters come through `take`.
  if (!has_focus_) ImGui::GetIO().InputQueueCharacters.resize(0);
  if (std::exchange(asks_for_focus_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1.0F);
  constexpr auto kField = ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll |
                          ImGuiInputTextFlags_CallbackCompletion |
                          ImGuiInputTextFlags_CallbackAlways;
  const bool entered = ImGui::InputTextWithHint("##path", "Name or path", &typed_, kField,
                                                &BrowserPanel::on_field, this);
  has_focus_ = ImGui::IsItemActive();
  if (has_focus_) is_suggestion_ = false;
  return entered;
}

void BrowserPanel::draw_filter() {
  const std::span<const FileKind> kinds = words_of(request_->purpose).kinds;
  if (!kinds.empty()) {
    ImGui::SetNextItemWidth(23.0F * ImGui::GetFontSize());
    if (ImGui::BeginCombo("##kind", in_words(kinds[kind_]).c_str())) {
      for (std::size_t k = 0; k < kinds.size(); ++k) {
        if (!ImGui::Selectable(in_words(kinds[k]).c_str(), k == kind_)) continue;
        kind_ = k;
        list();
      }
      ImGui::EndCombo();
    }
    ImGui::SameLine();
  }
  if (ImGui::Checkbox("Hidden files", &shows_hidden_)) list();
}

}  // namespace lapwing::viewer
