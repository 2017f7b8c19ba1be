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
  EXPECT_EQ(in_window_words("weight/domain_v: the ramp has no extent"),
            "Across the domain: the ramp has no extent");
  EXPECT_EQ(in_window_words("/home/a/.local/share/lapwing/ear.ply: byte 30: no faces"),
            "/home/a/.local/share/lapwing/ear.ply: byte 30: no faces");
  EXPECT_EQ(
      in_window_words("the region is not a disk. Choose another region, or replace it by "
                      "{\"disk_in\": REGION} to use the largest disk inside, which has 7 of its 9 "
                      "vertices"),
      "The region is not a disk. Choose another region, such as the largest disk inside, which "
      "has 7 of its 9 vertices");
  EXPECT_EQ(in_window_words("Add belt vertices there"), "Add fixed border vertices there");
}

// Messages of the engine that can reach the window.
TEST(WindowWords, MessagesQuoteNeitherRecipesNorTheCommandLine) {
  for (
      const char* message :
      {"target: the region is not a disk: it has 2 holes. Choose another region, or replace it by "
       "{\"disk_in\": REGION} to use the largest disk inside, which has 7 of its 9 vertices",
       "hole: the region must have one boundary loop, at which the part is joined; it has none. "
       "Choose another region, or use {\"disk_in\": REGION}",
       "vkWaitForFences: VK_ERROR_DEVICE_LOST; the driver lost the device. Try again, or run with "
       "--device cpu",
       "vkCreateFence: VK_ERROR_UNKNOWN; set LAPWING_VALIDATION=1 to learn why, or run with "
       "--device cpu",
       "no memory for the buffer \"Rows\" of 9 bytes on A: VK_ERROR; choose a smaller region, or "
       "run with --device cpu",
       "ear.ply already exists; choose another name for the new part (--name)",
       "ear.ply: the part is closed, so it has no boundary loop to join; cut it open with `lapwing "
       "cut`, or give a \"region\" of it",
       "ear.ply has no boundary loop to join a part at; cut a part out of the mesh with `lapwing "
       "cut`",
       "transplant: the part's faces pointed inward at its place, so they were flipped. If that is "
       "not intended, check \"place\", or check the part with `lapwing check`",
       "transplant: the result has a non-finite position at vertex 3, so the mesh is unchanged; "
       "run `lapwing check` on the part and on the mesh",
       "coat: the result has a non-finite position at vertex 3, so the mesh is unchanged; run "
       "`lapwing check` on source and target, and reduce \"amplitude\" or \"scale\"",
       "the system is singular at vertex 3, in component 1: belt and handle do not hold this "
       "component. Add belt vertices there, exclude it from the region, or run `lapwing check` to "
       "find degenerate triangles",
       "transplant: the residual is 1, above the limit of 0.1, so the mesh is unchanged; remesh "
       "both meshes around the seam with `lapwing remesh`",
       "coat: the residual is 1, above the limit of 0.1, so the mesh is unchanged; remesh the "
       "target patch with `lapwing remesh`, or choose a smaller patch",
       "source: the patch would need 9 vertices; it gets fewer, and the finest detail is lost. To "
       "keep it, refine the target with `lapwing remesh` first",
       "the rim has a non-finite position at index 3; find and repair it with `lapwing check`",
       "the patch to remesh has a non-finite position at vertex 3. Run `lapwing check --fix`, or "
       "choose another region",
       "the faces on either side of it have opposite orientations; run `lapwing check --fix` first",
       "vertex 3 of the patch has a non-finite position; exclude it, or repair the mesh with "
       "`lapwing check --fix`",
       "source: the surface is inside out, so the coat points inward; turn it with `lapwing check "
       "MESH --fix OUT`",
       "handle 1: the handle shares vertex 3 with the belt. Remove them from one of the two, for "
       "example with \"minus\"",
       "a move with a different scale for each axis can only be mirrored across a plane "
       "perpendicular to an axis; scale all axes equally, or give the move as a \"matrix\"",
       "handle 1: its mirror image contains vertex 3 of handle 2; give the handles of one side "
       "only, or remove \"mirror\"",
       "mirror: the mirror plane does not pass through the mesh; give a point of the plane, or "
       "\"auto\"",
       "the surface may rotate the other way: add \"commit_every\": 60 (or --commit-every 60)",
       "the surface may rotate the other way: set \"detail_length\" to 0.1 (or --detail-length "
       "0.1)",
       "commits. Raise \"commit_every\", or turn less",
       "hat.obj: it would be saved as a.obj, which is the mesh; give it another name with \"save\"",
       "weight/domain_v: only the square domain has a coordinate v; set \"domain\" to \"square\", "
       "or use \"distance_to\"",
       "transition: the transition contains a topological handle, around vertex 3; set its "
       "\"width\" below 0.2",
       "transition: no path leads across the transition from vertex 3 of the seam; make its "
       "\"width\" larger",
       "transplant: the seam would get about 9 triangles: make the part smaller, give "
       "\"transition\" a smaller \"width\", or set \"remesh\" to \"none\"",
       "a handle with free orientation requires settling with soft constraints; keep its "
       "orientation, or remove \"hard\" and \"settle\": false",
       "place: \"keep_size\" and \"scale\" exclude each other; remove one of the two"}) {
    const std::string words = in_window_words(message);
    EXPECT_THAT(words, Not(HasSubstr("{"))) << words;
    EXPECT_THAT(words, Not(HasSubstr("`"))) << words;
    EXPECT_THAT(words, Not(HasSubstr("--"))) << words;
    EXPECT_THAT(words, Not(::testing::ContainsRegex("\"[a-z_]"))) << words;
  }
}

TEST(WindowWords, NamesOfFilesStayAsTheyAre) {
  for (const char* message : {"belt.obj: line 3", "/home/ann/ROI/belt.obj cannot be read",
                              "hat.obj is not attached", "my-belt is missing"}) {
    EXPECT_EQ(in_window_words(message), message);
  }
}

}  // namespace
}  // namespace lapwing::viewer
