#include "viewer_panels/screen_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ui/view_pen.h"
#include "window/theme.h"

namespace lapwing::viewer::test {
namespace {

class ScreenReader : public ::testing::Test {
 protected:
  void SetUp() override {
    ImGui::CreateContext();
    set_fonts(1.0);
    set_theme(Theme::dark, 1.0);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {400.0F, 300.0F};
    io.DeltaTime = 1.0F / 60.0F;
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
  }
  void TearDown() override { ImGui::DestroyContext(); }

  // What is read of a window so wide with these contents.
  template <typename Draw>
  std::vector<ShownText> read(float width, const Draw& draw) {
    for (int frame = 0; frame < 3; ++frame) {
      ImGui::NewFrame();
      ImGui::SetNextWindowPos({10.0F, 10.0F});
      ImGui::SetNextWindowSize({width, 200.0F});
      ImGui::Begin("Panel", nullptr, ImGuiWindowFlags_NoTitleBar);
      draw();
      ImGui::End();
      ImGui::Render();
    }
    return read_screen(*ImGui::GetDrawData());
  }
};

TEST_F(ScreenReader, ReadsLinesAndWordsInOrder) {
  const auto texts = read(300.0F, [] {
    ImGui::TextUnformatted("two words, one line");
    ImGui::Button("Apply");
    ImGui::SameLine();
    ImGui::Button("Cancel");
  });
  ASSERT_EQ(texts.size(), 3U);
  EXPECT_EQ(texts[0].words, "two words, one line");
  EXPECT_EQ(texts[1].words, "Apply");
  EXPECT_EQ(texts[2].words, "Cancel");
  EXPECT_LT(texts[0].min.y, texts[1].min.y);
  EXPECT_LT(texts[1].max.x, texts[2].min.x);
  for (const ShownText& text : texts) {
    EXPECT_FALSE(text.is_cut) << text.words;
    EXPECT_GE(text.contrast, 4.5) << text.words;
  }
}

TEST_F(ScreenReader, SeesWhatAPanelOrAButtonCutsOff) {
  const auto text = read(90.0F, [] { ImGui::TextUnformatted("much longer than the panel"); });
  ASSERT_EQ(text.size(), 1U);
  EXPECT_TRUE(text[0].is_cut);
  const auto label = read(300.0F, [] { ImGui::Button("a label", {40.0F, 0.0F}); });
  ASSERT_EQ(label.size(), 1U);
  EXPECT_TRUE(label[0].is_cut);
}

TEST_F(ScreenReader, FindsTheWordsAtTheCursorInsideTheWindow) {
  for (const Eigen::Vector2d& place :
       {Eigen::Vector2d(390.0, 290.0), Eigen::Vector2d(-20.0, -5.0)}) {
    const auto texts = read(
        100.0F, [&] { draw_words(*ImGui::GetForegroundDrawList(), place, "words at the cursor"); });
    const auto text = find_text(texts, "words at the cursor");
    ASSERT_TRUE(text);
    EXPECT_FALSE(text->is_cut);
    EXPECT_GE(text->min.x, 0.0F);
    EXPECT_GE(text->min.y, 0.0F);
    EXPECT_LE(text->max.x, 400.0F);
    EXPECT_LE(text->max.y, 300.0F);
  }
}

TEST_F(ScreenReader, FindsLongWordsAtTheCursorInSeveralLines) {
  const auto texts = read(100.0F, [&] {
    draw_words(*ImGui::GetForegroundDrawList(), {390.0, 290.0},
               "Rotate 270 degrees about local X: the surface may rotate the other way. Rotate in "
               "several steps.");
  });
  EXPECT_GT(texts.size(), 2U);
  for (const ShownText& text : texts) {
    EXPECT_FALSE(text.is_cut) << text.words;
    EXPECT_LE(text.max.x, 400.0F) << text.words;
    EXPECT_LE(text.max.y, 300.0F) << text.words;
  }
}

TEST_F(ScreenReader, MeasuresContrast) {
  const auto contrast = [&](float ink, float ground) {
    const auto texts = read(300.0F, [&] {
      ImGui::PushStyleColor(ImGuiCol_Text, ImVec4{ink, ink, ink, 1.0F});
      ImGui::PushStyleColor(ImGuiCol_Button, ImVec4{ground, ground, ground, 1.0F});
      ImGui::Button("label");
      ImGui::PopStyleColor(2);
    });
    return texts.size() == 1 ? texts[0].contrast : 0.0;
  };
  EXPECT_NEAR(contrast(0.0F, 1.0F), 21.0, 0.01);
  EXPECT_NEAR(contrast(0.35F, 0.35F), 1.0, 0.01);
}

TEST_F(ScreenReader, LeavesOutWhatAWindowAboveHides) {
  const auto texts = read(300.0F, [] {
    ImGui::TextUnformatted("below");
    ImGui::SetNextWindowPos({10.0F, 10.0F});
    ImGui::SetNextWindowSize({200.0F, 100.0F});
    ImGui::Begin("Above", nullptr, ImGuiWindowFlags_NoTitleBar);
    ImGui::SetCursorPosY(60.0F);
    ImGui::TextUnformatted("above");
    ImGui::End();
  });
  EXPECT_FALSE(find_text(texts, "below"));
  EXPECT_TRUE(find_text(texts, "above"));
}

}  // namespace
}  // namespace lapwing::viewer::test
