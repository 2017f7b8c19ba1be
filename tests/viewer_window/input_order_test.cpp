// What a person does while a frame is slow comes to panels and picture in the order in which it was
// done.
#include <chrono>
#include <imgui.h>
#include <imgui_stdlib.h>
#include <random>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "lapwing/gpu/context.h"
#include "viewer_window/own_window_test.h"
#include "window/main_loop.h"

namespace lapwing::viewer {
namespace {

constexpr int kFieldCount = 3;
constexpr float kFieldHeight = 40.0F;
constexpr float kFieldWidth = 400.0F;
constexpr auto kSlowFrame = std::chrono::milliseconds(250);

// What came of a person's gestures.
struct Received {
  std::array<std::string, kFieldCount> fields;
  int button_clicks = 0;
  int double_clicks = 0;
  std::string picture;  // letters typed over it, '+' for a press, '-' for a release
};

// Three fields and a button at the left, a picture beside them, and frames that take long to draw.
// F1 over the picture quits; Home there opens a dialog with a field.
class TypingApp final : public App {
 public:
  bool handle(const InputEvent& event) override {
    if (event.kind == InputKind::text) received.picture += static_cast<char>(event.text);
    if (event.kind == InputKind::press) received.picture += '+';
    if (event.kind == InputKind::release) received.picture += '-';
    if (event.kind == InputKind::key && event.key == kF1) quits_ = true;
    if (event.kind == InputKind::key && event.key == kHome) opens_dialog_ = true;
    return true;
  }
  void open(const std::filesystem::path&) override {}
  void resize(const Eigen::Vector2d&, double) override {}
  void ask_to_close() override {}
  void use_device(std::shared_ptr<gpu::Context>) override {}
  std::string_view title() const override { return "Typing"; }
  bool wants_to_quit() const override { return quits_ || ++turns_ > kMostTurns; }

  void draw_ui(const FrameTimings&) override {
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize({kFieldWidth, 400.0F});
    ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
    for (std::size_t f = 0; f < kFieldCount; ++f) {
      ImGui::SetCursorPos({0.0F, kFieldHeight * static_cast<float>(f)});
      ImGui::PushID(static_cast<int>(f));
      ImGui::SetNextItemWidth(kFieldWidth);
      ImGui::InputText("##field", &received.fields[f]);
      ImGui::PopID();
    }
    ImGui::SetCursorPos({0.0F, kFieldHeight * kFieldCount});
    if (ImGui::Button("button", {kFieldWidth, 0.9F * kFieldHeight})) ++received.button_clicks;
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
      ++received.double_clicks;
    }
    draw_dialog();
    ImGui::End();
    Window::wake();
  }

  Scene scene() override {
    std::this_thread::sleep_for(kSlowFrame);
    drawn = true;
    return {};
  }

  Received received;
  std::string answer;  // to the dialog
  std::atomic<bool> drawn = false;

 private:
  static constexpr int kMostTurns = 300;

  void draw_dialog() {
    if (opens_dialog_) ImGui::OpenPopup("dialog");
    opens_dialog_ = false;
    if (!ImGui::BeginPopupModal("dialog")) return;
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    if (ImGui::InputText("##answer", &answer, ImGuiInputTextFlags_EnterReturnsTrue)) {
      ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
  }

  bool opens_dialog_ = false;
  bool quits_ = false;
  mutable int turns_ = 0;
};

// Gestures as arguments of xdotool, and what is to come of them.
class Gestures {
 public:
  void click_field(std::size_t field) {
    click_at(340 + next_offset(), middle_of(field));
    active_ = field;
  }
  void click_button() {
    click_at(40 + next_offset(), middle_of(kFieldCount));
    ++expected.button_clicks;
    active_.reset();
  }
  void click_picture() {
    click_at(480 + next_offset(), 200);
    expected.picture += "+-";
    active_.reset();
  }
  // Pressed over the button and let go elsewhere.
  void press_button_and_leave() {
    script += at(40 + next_offset(), middle_of(kFieldCount)) + "mousedown 1 ";
    script += at(500, 300) + "mouseup 1 ";
    active_.reset();
  }
  void type(const std::string& letters) {
    for (const char letter : letters) script += std::string("key ") + letter + " ";
    (active_ ? expected.fields[*active_] : expected.picture) += letters;
  }
  void erase(int letters) {
    for (int k = 0; k < letters; ++k) {
      script += "key BackSpace ";
      if (active_ && !expected.fields[*active_].empty()) expected.fields[*active_].pop_back();
    }
  }
  void end_typing() {
    script += "key Return ";
    active_.reset();
  }
  void quit() {
    click_picture();
    script += "key F1 ";
  }
  std::size_t length() const { return active_ ? expected.fields[*active_].size() : 0; }

  std::string script;
  Received expected;

 private:
  static std::string at(int x, int y) {
    return "mousemove " + std::to_string(x) + " " + std::to_string(y) + " ";
  }
  static int middle_of(std::size_t row) {
    return static_cast<int>(kFieldHeight * static_cast<float>(row)) + 10;
  }
  void click_at(int x, int y) { script += at(x, y) + "click 1 "; }
  // Two clicks at one place are a double click.
  int next_offset() { return 12 * (++clicks_ % 4); }

  std::optional<std::size_t> active_;  // the field that is typed into
  int clicks_ = 0;
};

class InputOrder : public test::OwnWindowTest {
 protected:
  // Once the window shows, the gestures, as fast as the display takes them.
  void run(const std::string& gestures) {
    WindowGraphics graphics(*window_, "auto");
    std::thread person([&] {
      lapwing::test::eventually(60.0, [&] { return app_.drawn.load(); });
      desktop_->xdotool(gestures);
    });
    run_main_loop(*window_, graphics, graphics.open_device(), app_);
    person.join();
  }

  TypingApp app_;
};

TEST_F(InputOrder, ABurstWithinSlowFramesComesAsItWasDone) {
  std::mt19937 random(20261125);
  const auto below = [&](unsigned int bound) { return random() % bound; };
  Gestures person;
  person.click_field(0);
  for (int k = 0; k < 120; ++k) {
    switch (below(8)) {
      case 0:
      case 1:
        person.click_field(below(kFieldCount));
        break;
      case 2:
        person.click_picture();
        break;
      case 3:
        person.click_button();
        break;
      case 4:
        person.press_button_and_leave();
        break;
      case 5:
        person.erase(1 + static_cast<int>(below(3)));
        break;
      case 6:
        person.end_typing();
        break;
      default:
        if (person.length() > 12) person.erase(10);
        person.type(
            std::string{static_cast<char>('a' + below(26)), static_cast<char>('a' + below(26))});
    }
  }
  person.quit();
  run(person.script);
  EXPECT_EQ(app_.received.fields, person.expected.fields);
  EXPECT_EQ(app_.received.picture, person.expected.picture);
  EXPECT_EQ(app_.received.button_clicks, person.expected.button_clicks);
}

TEST_F(InputOrder, ADoubleClickWithinOneFrameIsOne) {
  run("mousemove 60 130 click 1 click 1 mousemove 500 200 key F1");
  EXPECT_EQ(app_.received.button_clicks, 2);
  EXPECT_EQ(app_.received.double_clicks, 1);
}

TEST_F(InputOrder, WhatIsTypedRightAfterADialogOpensIsItsAnswer) {
  run("mousemove 500 200 key b key Home key o key w key l key Return key c key F1");
  EXPECT_EQ(app_.answer, "owl");
  EXPECT_EQ(app_.received.picture, "bc");
}

}  // namespace
}  // namespace lapwing::viewer
