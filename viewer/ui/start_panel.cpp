#include <algorithm>
#include <array>
#include <imgui.h>
#include <utility>

#include "files/path_text.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "window/theme.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

// Connected meshes with detail that an edit could lose, and the recipes of the demo.
constexpr std::array kSamples{
    "models/cgal/meshes/armadillo.off", "models/cgal/meshes/cactus.off",
    "models/cgal/meshes/camel.off",     "models/cgal/meshes/elephant.off",
    "models/cgal/meshes/hand.off",      "models/cgal/meshes/lion-head.off",
    "models/cgal/meshes/nefertiti.off"};
constexpr std::array kRecipes{"raise-arm.json", "bend-cactus.json"};

float column_width() {
  return 9.0F * ImGui::GetFontSize();
}

// Draws buttons in rows of three. Returns the index of the one that was pressed.
template <typename Items, typename NameOf>
std::optional<std::size_t> pressed_button(const Items& items, const NameOf& name_of) {
  std::optional<std::size_t> chosen;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i % 3 != 0) ImGui::SameLine();
    if (ImGui::Button(name_of(items[i]).c_str(), {column_width(), 0.0F})) chosen = i;
  }
  return chosen;
}

void draw_start_trouble(const std::string& trouble) {
  ImGui::PushStyleColor(ImGuiCol_Text, text_color(Tone::error));
  ImGui::PushTextWrapPos(3.2F * column_width());
  ImGui::TextUnformatted(trouble.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ImGui::Spacing();
}

// Lists the files that were opened last, one per line. Their folders distinguish files of the same
// name.
std::optional<fs::path> draw_recent(std::span<const RecentFiles::Item> items) {
  constexpr std::size_t kMost = 6;
  std::optional<fs::path> chosen;
  if (items.empty()) return chosen;
  ImGui::Spacing();
  ImGui::TextDisabled("Recent");
  for (std::size_t k = 0; k < std::min(items.size(), kMost); ++k) {
    const RecentFiles::Item& item = items[k];
    ImGui::PushID(static_cast<int>(k));
    const auto flags = item.is_there ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
    if (ImGui::Selectable(item.path.filename().c_str(), false, flags)) chosen = item.path;
    ImGui::SameLine(column_width());
    ImGui::TextDisabled("%s%s", with_tilde(item.path.parent_path()).c_str(),
                        item.is_there ? "" : " (missing)");
    ImGui::PopID();
  }
  return chosen;
}

}  // namespace

std::vector<fs::path> find_samples() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  // build/PRESET/bin/lapwing-viewer
  const fs::path built = program.parent_path().parent_path().parent_path();
  std::vector<fs::path> found;
  const auto add = [&](std::initializer_list<fs::path> places) {
    for (const fs::path& place : places) {
      if (!fs::exists(place, ignored)) continue;
      found.push_back(place);
      return;
    }
  };
  for (const char* sample : kSamples) add({fs::path("build") / sample, built / sample});
  if (found.empty()) return found;
  const fs::path recipes = fs::path("tools") / "recipes";
  for (const char* recipe : kRecipes) {
    add({recipes / recipe, built.parent_path() / recipes / recipe});
  }
  return found;
}

std::optional<Choice> draw_start_panel(const StartOffer& offer, bool* open) {
  std::optional<Choice> choice;
  center_next_window();
  ImGui::Begin(
      "Open mesh", open,
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
  if (!offer.trouble.empty()) draw_start_trouble(offer.trouble);
  ImGui::TextDisabled("Drop a mesh (OBJ, OFF, PLY, STL or glTF) or a recipe on the window, or");
  if (ImGui::Button("Choose file... (Ctrl+O)")) choice = AnotherFile{};
  if (const auto recent = draw_recent(offer.recent)) choice = *recent;
  if (!offer.samples.empty()) {
    ImGui::Spacing();
    ImGui::TextDisabled("Samples");
    const auto name = [](const fs::path& path) {
      return path.extension() == ".json" ? path.filename().string() : path.stem().string();
    };
    if (const auto chosen = pressed_button(offer.samples, name)) choice = offer.samples[*chosen];
  }
  ImGui::Spacing();
  ImGui::TextDisabled("Primitives");
  const auto name = [](const NamedShape& shape) {
    std::string words(shape.name);
    std::ranges::replace(words, '-', ' ');
    return in_window_words(std::move(words));
  };
  if (const auto chosen = pressed_button(named_shapes(), name)) choice = &named_shapes()[*chosen];
  ImGui::End();
  return choice;
}

}  // namespace lapwing::viewer
