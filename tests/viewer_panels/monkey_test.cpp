// Thousands of random gestures: nothing breaks, and what a crash would leave is what there was.
#include "viewer_panels/monkey.h"

#include <deque>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "state/journal.h"
#include "support/environment.h"
#include "support/gpu.h"
#include "support/keep_picture.h"

namespace lapwing::viewer::test {
namespace {

namespace fs = std::filesystem;
using lapwing::test::Environment;

// The journal is read again after so many gestures.
constexpr std::size_t kGesturesPerReading = 10;
constexpr std::size_t kTold = 25;  // the gestures before what went wrong
constexpr Look kLook{Theme::dark, {800, 600}, 1.0};

// More by $LAPWING_GESTURES.
std::size_t gesture_count() {
  return static_cast<std::size_t>(lapwing::test::how_often("LAPWING_GESTURES", 120));
}

// As a recipe that says whether the last step has its result.
std::string in_words(const Draft& draft) {
  Recipe recipe{.steps = draft.steps};
  recipe.steps.emplace_back(draft.open);
  return to_json(recipe) + (draft.settled ? "settled\n" : "open\n");
}

class MonkeyTest : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    context_ = std::make_shared<gpu::Context>();
    write_mesh(rippled_cylinder(24, 31), folder_ / "tube.obj");
    write_mesh(icosphere(3), folder_ / "ball.ply");
    write_mesh(rippled_cylinder(12, 21), folder_ / "other.obj");
    add_finger(folder_.path(), 12, 8);
    start();
  }

  void start() {
    viewer_.reset();
    viewer_ = std::make_unique<ShownViewer>(context_, kLook, folder_.path());
  }

  const Document* document() const { return viewer_->app().document(); }
  const Editor& editor() const { return document()->editor; }

  // What the journal of the running viewer says; nothing without one.
  std::optional<Draft> journalled() const {
    std::optional<Draft> found;
    if (!fs::exists(folder_ / "journals")) return found;
    for (const auto& entry : fs::directory_iterator(folder_ / "journals")) {
      const auto edit = read_journal(entry.path());
      if (!edit) continue;
      EXPECT_FALSE(found) << "two journals of one viewer";
      found = edit->draft;
    }
    return found;
  }

  void expect_sound() {
    if (document() == nullptr || !document()->opened.file) return;
    EXPECT_EQ(editor().session().warning(), "");
    const AppState& state = editor().state();
    const Draft draft = draft_of(state);
    const Draft written = journalled().value_or(Draft{});
    EXPECT_EQ(written, draft) << "journal and history:\n" << in_words(written) << in_words(draft);
    for (const Eigen::Vector3d& position : editor().view().positions()) {
      ASSERT_TRUE(position.allFinite());
    }
  }

  // Until nothing is asked, read, settled or carried out any more. Opens a mesh if there is none.
  void come_to_rest() {
    for (int k = 0; k < 4; ++k) viewer_->key(kEscape);
    if (document() == nullptr) viewer_->open(folder_ / "tube.obj");
    viewer_->wait_for(
        [&] {
          return !viewer_->app().asks_for_path() && document() != nullptr &&
                 !editor().actions().waits() && !editor().session().is_carrying_out() &&
                 !editor().session().awaits_result();
        },
        "the viewer comes to rest");
  }

  void go_back_and_forth() {
    const Positions positions = positions_of(editor().state());
    const Draft draft = draft_of(editor().state());
    const std::size_t done = editor().session().history().done();
    const auto step = [&](const Modifiers& held) {
      const std::size_t before = editor().session().history().done();
      viewer_->key('Z', held);
      return editor().session().history().done() != before;
    };
    while (editor().session().history().done() > 0) ASSERT_TRUE(step(kControl)) << "undo";
    EXPECT_EQ(positions_of(editor().state()), document()->opened.mesh->positions);
    while (editor().session().history().done() < done) ASSERT_TRUE(step(kControlShift)) << "redo";
    EXPECT_EQ(draft_of(editor().state()), draft);
    EXPECT_EQ(positions_of(editor().state()), positions) << "undone and redone";
  }

  // As after a SIGKILL: nothing is closed, and the next one restores it.
  void crash_and_restore() {
    const Positions positions = positions_of(editor().state());
    const Draft draft = draft_of(editor().state());
    if (draft == Draft{}) return;
    start();
    viewer_->app().offer_interrupted();
    viewer_->click("Restore");
    viewer_->wait_for([&] { return document() != nullptr; }, "the edit is restored");
    come_to_rest();
    EXPECT_EQ(draft_of(editor().state()), draft);
    EXPECT_EQ(positions_of(editor().state()), positions) << "restored";
  }

  TemporaryFolder folder_;
  Environment data_{"XDG_DATA_HOME", (folder_ / "data").string()};
  Environment no_programs_{"PATH", ""};  // no dialogs of the desktop
  std::shared_ptr<gpu::Context> context_;
  std::unique_ptr<ShownViewer> viewer_;
};

TEST_P(MonkeyTest, BreaksNothingAndLosesNothing) {
  Monkey monkey(*viewer_, GetParam());
  viewer_->open(folder_ / "tube.obj");
  std::deque<std::string> told;
  std::size_t without_mesh = 0;
  for (std::size_t gesture = 0; gesture < gesture_count(); ++gesture) {
    told.push_back(monkey.act());
    if (told.size() > kTold) told.pop_front();
    if (viewer_->app().wants_to_quit()) {
      EXPECT_FALSE(journalled()) << "what was given up or saved is not restored";
      start();
      monkey.go_to(*viewer_);
    } else if (gesture % kGesturesPerReading == 0) {
      expect_sound();
    }
    if (document() == nullptr) ++without_mesh;
    if (HasFailure()) {
      for (const std::string& words : told) std::cerr << words << '\n';
      lapwing::test::keep_picture(viewer_->picture(), "monkey");
      FAIL() << "after gesture " << gesture;
    }
  }
  EXPECT_LT(without_mesh, gesture_count() / 4) << "most of the time there is something to edit";
  come_to_rest();
  monkey.edit();
  come_to_rest();
  expect_sound();
  go_back_and_forth();
  crash_and_restore();
  if (HasFailure()) {
    for (const std::string& words : told) std::cerr << words << '\n';
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, MonkeyTest, ::testing::Values(1, 2));

}  // namespace
}  // namespace lapwing::viewer::test
