#include "viewer_panels/shown_viewer.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "window/theme.h"

namespace lapwing::viewer::test {
namespace {

constexpr auto kPause = std::chrono::milliseconds(5);
constexpr double kPatienceMs = 60'000.0;
// ImGui knows what is under the mouse from the frame before.
constexpr int kFramesPerChange = 3;

}  // namespace

ShownViewer::ShownViewer(std::shared_ptr<gpu::Context> context, const Look& look)
    : look_(look),
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
  app_.resize({look_.size.width, look_.size.height}, look_.scale);
}

ShownViewer::~ShownViewer() {
  ImGui::DestroyContext();
}

void ShownViewer::lay_out() {
  painter_.finish_frame(timings_);
  ImGui::NewFrame();
  app_.draw_ui(timings_);
  ImGui::Render();
}

const std::vector<ShownText>& ShownViewer::look_at() {
  for (int k = 0; k < kFramesPerChange; ++k) lay_out();
  // What the frame asked of the device is done once it is drawn.
  painter_.paint(look_.size, app_.scene(), *ImGui::GetDrawData());
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
  painter_.finish_frame(timings_);
  return screen_.picture();
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

void ShownViewer::point_at(const std::string& words) {
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
