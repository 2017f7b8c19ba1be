#include "work/window_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/recipe/key_visitor.h"
#include "lapwing/recipe/step.h"

namespace lapwing::viewer {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Collects the keys that the panels show, and enters every object.
class ShownKeys final : public KeyVisitor {
 public:
  std::vector<StepKey> keys;

 protected:
  void other(const StepKey& key) override { keys.push_back(key); }
  bool enter(const StepKey& key, bool& given, ObjectForm, bool) override {
    keys.push_back(key);
    return given = true;
  }
};

TEST(WindowWords, EverySettingHasALabelAndATooltip) {
  ShownKeys shown;
  DeformParameters deform;
  describe(deform, shown);
  CoatOptions options;
  describe(options, shown);
  CoatParameters coat;
  describe(coat, shown);
  TransplantParameters transplant;
  describe(transplant, shown);
  ASSERT_GT(shown.keys.size(), 20U);
  for (const StepKey& key : shown.keys) {
    const KeyWords* words = words_of_key(key.name, key.flag);
    ASSERT_NE(words, nullptr) << key.name;
    EXPECT_THAT(std::string(words->help), Not(IsEmpty())) << key.name;
    for (const char* jargon : {"ROI", "belt", "`", "settl"}) {
      EXPECT_THAT(std::string(words->help), Not(HasSubstr(jargon))) << key.name;
    }
  }
}

TEST(WindowWords, AWidthIsThatOfItsObject) {
  EXPECT_EQ(words_of_key("width", "transition")->label, "Transition width");
  EXPECT_EQ(words_of_key("width", "belt")->label, "Held width");
}

TEST(WindowWords, ChoicesAndStagesAreInPlainWords) {
  EXPECT_EQ(choice_in_words("carry"), "Move along");
  EXPECT_EQ(choice_in_words("uniform"), "Uniform");
  EXPECT_EQ(stage_in_words("normal_matrix"), "Assembling the matrix");
  EXPECT_EQ(stage_in_words("a new stage"), "a new stage");
}

TEST(WindowWords, MessagesNameLabelsInsteadOfKeys) {
  EXPECT_EQ(in_window_words("handle 1: the handle extends beyond the ROI. Enlarge the ROI."),
            "Handle 1: the handle extends beyond the region. Enlarge the region.");
  EXPECT_EQ(in_window_words("not enough memory; choose a smaller region, or turn on \"settle\""),
            "Not enough memory; choose a smaller region, or turn on \"Refine\" in the solver "
            "settings");
  EXPECT_EQ(in_window_words("choose a narrower \"transition\", or set \"remesh\" to \"none\""),
            "Choose a narrower \"Transition\", or set \"Remesh\" to \"Off\"");
  EXPECT_EQ(in_window_words("sources/0/boundary_pairs: the disk needs one pair"),
            "Border points: the disk needs one pair");
  EXPECT_EQ(in_window_words("Add belt vertices there"), "Add fixed border vertices there");
}

TEST(WindowWords, NamesOfFilesStayAsTheyAre) {
  for (const char* message : {"belt.obj: line 3", "/home/ann/ROI/belt.obj cannot be read",
                              "hat.obj is not attached", "my-belt is missing"}) {
    EXPECT_EQ(in_window_words(message), message);
  }
}

}  // namespace
}  // namespace lapwing::viewer
