#include "viewer_panels/shown_viewer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "run/transplant_runs.h"
#include "window/theme.h"

namespace lapwing::viewer::test {
namespace {

constexpr auto kPause = std::chrono::milliseconds(5);
constexpr double kPatienceMs = 60'000.0;
// ImGui knows what is under the mouse from the frame before.
constexpr int kFramesPerChange = 3;

// Keys of the panels; letters are their own code.
constexpr auto kPanelKeys =
    std::to_array<std::pair<ImGuiKey, int>>({{ImGuiKey_Tab, kTab},
                                             {ImGuiKey_LeftArrow, kLeft},
                                             {ImGuiKey_RightArrow, kRight},
                                             {ImGuiKey_UpArrow, kUp},
                                             {ImGuiKey_DownArrow, kDown},
                                             {ImGuiKey_Home, kHome},
                                             {ImGuiKey_End, kEnd},
                                             {ImGuiKey_Delete, kDelete},
                                             {ImGuiKey_Backspace, kBackspace},
                                             {ImGuiKey_Enter, kEnter},
                                             {ImGuiKey_Escape, kEscape},
                                             {ImGuiKey_A, 'A'},
                                             {ImGuiKey_C, 'C'},
                                             {ImGuiKey_V, 'V'},
                                             {ImGuiKey_X, 'X'},
                                             {ImGuiKey_Y, 'Y'},
                                             {ImGuiKey_Z, 'Z'}});

ImVec2 place_of(const Eigen::Vector2d& pixel) {
  return {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
}

// ImGui's.
std::optional<int> button_of(MouseButton button) {
  switch (button) {
    case MouseButton::left:
      return 0;
    case MouseButton::right:
      return 1;
    case MouseButton::middle:
      return 2;
    case MouseButton::none:
      return {};
  }
  return {};
}

}  // namespace

void add_finger(const std::filesystem::path& folder, int sides, int rings) {
  const std::filesystem::path parts = folder / "data" / "lapwing" / "parts";
  std::filesystem::create_directories(parts);
  write_mesh(lapwing::test::finger(sides, rings, 0.2, 0.6), parts / "finger.ply");
}

ShownViewer::ShownViewer(std::shared_ptr<gpu::Context> context, const Look& look,
                         std::filesystem::path folder)
    : own_folder_(folder.empty() ? std::make_optional<TemporaryFolder>() : std::nullopt),
      folder_(own_folder_ ? own_folder_->path() : std::move(folder)),
      look_(look),
      context_(std::move(context)),
      screen_(*context_),
      painter_(*context_, screen_),
      app_(context_, {folder_ / "journals", folder_ / "viewer.json", folder_ / "recent-files"}) {
  ImGui::CreateContext();
  set_fonts(look_.scale);
  set_theme(look_.theme, look_.scale);
  painter_.set_fonts();
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(look_.size.width), static_cast<float>(look_.size.height)};
  io.DeltaTime = 1.0F / 60.0F;
  io.MousePos = {-1.0F, -1.0F};
  for (const auto& [panel_key, key] : kPanelKeys) io.KeyMap[panel_key] = key;
  app_.resize({look_.size.width, look_.size.height}, look_.scale);
}

ShownViewer::~ShownViewer() {
  ImGui::DestroyContext();
}

void ShownViewer::lay_out() {
  ImGui::NewFrame();
  app_.draw_ui(timings_);
  ImGui::Render();
}

// What the frame asked of the device is done once it is drawn. Nothing that happens next finds the
// device at work.
void ShownViewer::draw(bool at_rest) {
  painter_.paint(look_.size, app_.scene(), *ImGui::GetDrawData(), at_rest);
  painter_.finish_frame(timings_);
}

const std::vector<ShownText>& ShownViewer::look_at() {
  for (int k = 0; k < kFramesPerChange; ++k) lay_out();
  draw(true);
  return texts_ = read_screen(*ImGui::GetDrawData());
}

void ShownViewer::wait_for(const std::function<bool()>& happened, const std::string& what) {
  const Stopwatch waited;
  while (waited.elapsed_ms() < kPatienceMs) {
    look_at();
    if (happened()) return;
    std::this_thread::sleep_for(kPause);
  }
  ADD_FAILURE() << "never: " << what << "; there is" << all_texts();
}

void ShownViewer::open(const std::filesystem::path& mesh) {
  app_.open(mesh);
  wait_for([this] { return app_.scene().surface != nullptr; }, mesh.string() + " opens");
}

bool ShownViewer::says(const std::string& words) const {
  return std::any_of(texts_.begin(), texts_.end(), [&](const ShownText& text) {
    return text.words.find(words) != std::string::npos;
  });
}

std::string ShownViewer::all_texts() const {
  std::string all;
  for (const ShownText& each : texts_) all += "\n  " + each.words;
  return all;
}

Image ShownViewer::picture() {
  look_at();
  return screen_.picture();
}

void ShownViewer::press_and_release(const InputEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  for (const bool down : {true, false}) {
    io.KeysDown[event.key] = down;
    io.KeyCtrl = down && event.modifiers.control;
    io.KeyShift = down && event.modifiers.shift;
    io.KeyAlt = down && event.modifiers.alt;
    lay_out();
  }
}

void ShownViewer::send(const InputEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  const bool is_for_picture = picture_.gets(event.kind, event.button, event.position);
  const bool has_place = event.kind != InputKind::key && event.kind != InputKind::text;
  if (has_place) io.MousePos = place_of(event.position);
  if (const auto button = button_of(event.button); button && event.kind != InputKind::move) {
    io.MouseDown[*button] = event.kind == InputKind::press;
  }
  if (event.kind == InputKind::scroll) io.MouseWheel += static_cast<float>(event.scroll);
  if (event.kind == InputKind::text && !is_for_picture) {
    io.AddInputCharacter(static_cast<unsigned int>(event.text));
  }
  if (is_for_picture) {
    InputEvent seen = event;
    if (event.kind == InputKind::move) seen.button = picture_.dragging();
    app_.handle(seen);
  }
  if (event.kind == InputKind::key) {
    press_and_release(event);
  } else {
    lay_out();
  }
  draw(false);
}

void ShownViewer::key(int key, const Modifiers& modifiers) {
  app_.handle({.kind = InputKind::key, .modifiers = modifiers, .key = key});
  look_at();
}

void ShownViewer::type(char32_t character) {
  app_.handle({.kind = InputKind::text, .text = character});
  look_at();
}

void ShownViewer::place_mouse(const ImVec2& at) {
  ImGui::GetIO().MousePos = at;
  for (int k = 0; k < kFramesPerChange; ++k) lay_out();
}

void ShownViewer::scroll_to(const std::string& words) {
  const auto scroll = [this](float notches) {
    place_mouse({0.1F * static_cast<float>(look_.size.width),
                 0.25F * static_cast<float>(look_.size.height)});
    ImGui::GetIO().MouseWheel = notches;
    lay_out();
    place_mouse({-1.0F, -1.0F});  // a tooltip could hide the words
  };
  if (find_text(look_at(), words)) return;
  scroll(1000.0F);
  if (find_text(look_at(), words)) return;
  for (int k = 0; k < 100 && !find_text(look_at(), words); ++k) scroll(-0.5F);
  scroll(-0.3F);  // away from the lower edge
}

void ShownViewer::point_at(const std::string& words) {
  scroll_to(words);
  const auto text = find_text(look_at(), words);
  ASSERT_TRUE(text.has_value()) << "nothing says " << words << "; there is" << all_texts();
  place_mouse(text->middle());
  look_at();
}

void ShownViewer::click(const std::string& words) {
  point_at(words);
  for (const bool down : {true, false}) {
    ImGui::GetIO().MouseDown[0] = down;
    lay_out();
  }
  place_mouse({-1.0F, -1.0F});
  look_at();
}

void ShownViewer::drag(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const auto send = [this](InputKind kind, const Eigen::Vector2d& at, MouseButton button) {
    app_.handle({.kind = kind, .position = at, .button = button});
    look_at();
  };
  send(InputKind::move, from, MouseButton::none);
  send(InputKind::press, from, MouseButton::left);
  send(InputKind::move, 0.5 * (from + to), MouseButton::left);
  send(InputKind::move, to, MouseButton::left);
  send(InputKind::release, to, MouseButton::left);
}

}  // namespace lapwing::viewer::test
