// Every key that a person needs for an edit, a coat, a mix or a transplant stands on the screen
// when it is needed: in the guide, at the control that does the same, or in a menu.
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"
#include "run/transplant_runs.h"
#include "state/waypoints.h"
#include "support/environment.h"
#include "support/gpu.h"
#include "transplant/loops.h"
#include "viewer_panels/shown_viewer.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::Environment;

class Guides : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    add_finger(folder_.path());
    write_mesh(rippled_cylinder(24, 41), folder_ / "tube.obj");
    start();
  }
  void start() {
    viewer_.reset();
    viewer_ =
        std::make_unique<ShownViewer>(std::make_shared<gpu::Context>(), Look{}, folder_.path());
    viewer_->open(folder_ / "tube.obj");
  }

  // Where the mesh is, right of the panels and of a source.
  Eigen::Vector2d middle() const {
    const auto& [width, height] = viewer_->look().size;
    const bool has_source = viewer_->app().document()->desk.is_open();
    return {(has_source ? 0.82 : 0.65) * width, 0.55 * height};
  }
  void drag_disk(double radius) {
    viewer_->drag(middle(), middle() + Eigen::Vector2d(radius, 0.0));
  }
  void drag_disk_of_source() {
    const auto& [width, height] = viewer_->look().size;
    const Eigen::Vector2d source(0.45 * width, 0.55 * height);
    viewer_->drag(source, source + Eigen::Vector2d(60.0, 0.0));
  }
  void choose_roi() {
    viewer_->key('I');
    drag_disk(60.0);
    ASSERT_FALSE(roi().vertices.empty());
  }
  void place_part() {
    viewer_->key('N');
    viewer_->wait_for([&] { return viewer_->says("Shift+wheel rotates"); }, "the part is in hand");
    viewer_->drag(middle(), middle());
  }
  // Places a part that is too short for a transition of the usual width.
  void place_a_short_part() {
    write_mesh(lapwing::test::finger(24, 2, 0.2, 0.02), folder_ / "data/lapwing/parts/finger.ply");
    start();
    place_part();
    viewer_->scroll_to("Seam settings");
    viewer_->click("Seam settings");
    viewer_->scroll_to("Transition");
    viewer_->click("Transition");
  }
  // Until it has settled.
  void move_handle() {
    viewer_->key('G');
    viewer_->type(U'1');
    viewer_->key(kEnter);
    const Editor& editor = viewer_->app().document()->editor;
    viewer_->wait_for([&] { return editor.state().settled && !editor.actions().waits(); },
                      "it settles");
  }
  const ChosenRegion& roi() const {
    return viewer_->app().document()->editor.state().selection.roi;
  }

  // Without doing anything.
  void expect_says(const std::string& words) {
    viewer_->look_at();
    EXPECT_TRUE(viewer_->says(words)) << "nothing says " << words;
  }
  // While the mouse is over a control, whose name others may have, too.
  void expect_at(const std::string& control, const std::string& words) {
    bool said = false;
    const std::vector<ShownText> texts = viewer_->look_at();
    for (const ShownText& text : texts) {
      if (text.words != control || said) continue;
      move_to({text.middle().x, text.middle().y});
      said = viewer_->says(words);
    }
    EXPECT_TRUE(said) << control << " does not say " << words;
    move_to({1.0, 1.0});
  }
  void move_to(const Eigen::Vector2d& place) {
    viewer_->send({.kind = InputKind::move, .position = place});
    viewer_->look_at();
  }
  // Types into the field that has the keyboard focus.
  void type_line(const std::string& line) {
    for (const char letter : line) {
      viewer_->send({.kind = InputKind::key, .key = std::toupper(letter)});
      viewer_->send({.kind = InputKind::text, .text = static_cast<char32_t>(letter)});
    }
    viewer_->send({.kind = InputKind::key, .key = kEnter});
    viewer_->look_at();
  }
  void expect_in_menu(const std::string& menu, const std::string& keys) {
    viewer_->click(menu);
    EXPECT_TRUE(viewer_->says(keys)) << menu << " does not say " << keys;
    viewer_->click(menu);
  }

  TemporaryFolder folder_;
  Environment home_{"HOME", folder_.path().string()};
  Environment data_{"XDG_DATA_HOME", (folder_ / "data").string()};
  std::unique_ptr<ShownViewer> viewer_;
};

TEST_F(Guides, NameTheKeysOfAnEdit) {
  expect_says("Drag the surface.");
  viewer_->key('I');
  expect_says("Drag from the centre of the region to its edge");
  expect_at("Region", "Shortcut: I");
  expect_at("Disk", "Shortcut: D");
  choose_roi();
  expect_at("Handle", "Shortcut: H");
  viewer_->key('H');
  drag_disk(20.0);
  expect_at("Move", "Shortcut: M");
  viewer_->key('M');
  expect_says("G");
  move_handle();
  expect_says("Ctrl+N begins another edit");
  expect_at("Undo", "Ctrl+Z");
  expect_at("Redo", "Ctrl+Shift+Z");
  expect_at("Save recipe...", "Ctrl+E");
  expect_at("Shape", "Shift+M");
  for (const char* keys : {"Ctrl+O", "Ctrl+S", "Ctrl+Shift+S", "Ctrl+P", "Ctrl+Q"}) {
    expect_in_menu("File", keys);
  }
  for (const char* keys : {"Home", "Tab"}) expect_in_menu("View", keys);
}

TEST_F(Guides, NameTheKeysOfACoat) {
  viewer_->click("Coat");
  expect_at("New coat", "Ctrl+K");
  viewer_->key('K', kControl);
  viewer_->wait_for([&] { return viewer_->says("Source: "); }, "the coat begins");
  expect_says("Press I");
  choose_roi();
  expect_says("Ctrl+Shift+K opens another mesh");
  expect_at("Apply", "Ctrl+Enter");
  viewer_->click("Use whole source");
  expect_says("K to pick corresponding points");
}

// It stays what it was in each frame, so that what is chosen on it stays, too.
TEST_F(Guides, LeadFromADragToACoatOfWhatWasMoved) {
  choose_roi();
  viewer_->key('H');
  drag_disk(20.0);
  move_handle();
  viewer_->key('K', kControl);
  viewer_->wait_for([&] { return viewer_->says("Source: "); }, "the coat begins");
  viewer_->click("Use whole source");
  expect_says("Source patch: 984 vertices");
  const auto& preview = viewer_->app().document()->desk.preview();
  viewer_->wait_for([&] { return !preview.message().empty(); }, "the preview says what it misses");
  EXPECT_THAT(preview.message(), ::testing::HasSubstr("disk"));
  viewer_->look_at();
  EXPECT_FALSE(preview.is_behind()) << "it is not computed again and again";
}

TEST_F(Guides, NameTheKeysOfAMix) {
  viewer_->click("Mix");
  expect_at("New mix", "Ctrl+M");
  viewer_->key('M', kControl);
  viewer_->wait_for([&] { return viewer_->says("Source: "); }, "the mix begins");
  choose_roi();
  viewer_->click("Use whole source");
  expect_says("Press Shift+K");
  expect_at("Apply", "Ctrl+Enter");
}

TEST_F(Guides, NameTheKeysOfATransplant) {
  viewer_->click("Transplant");
  expect_at("finger", "N picks up");
  viewer_->key('N');
  viewer_->wait_for([&] { return viewer_->says("Shift+wheel rotates"); }, "the part is in hand");
  expect_says("Click");
  viewer_->drag(middle(), middle());
  expect_says("Enter");
  expect_at("Apply", "Enter");
  expect_at("Pick up (G)", "G");
  viewer_->key(kEnter);
  const Document& document = *viewer_->app().document();
  viewer_->wait_for([&] { return !document.transplant.is_open(); }, "the part is applied");
  ASSERT_NE(document.editor.tool().row(), nullptr);
  EXPECT_EQ(document.editor.tool().row()->action, Action::take_disk);
  EXPECT_EQ(document.editor.tool().part().role, Part::Role::roi);
}

TEST_F(Guides, AWarningOfATransplantOffersToEditItsStep) {
  place_a_short_part();
  viewer_->key(kEnter);
  viewer_->wait_for([&] { return viewer_->shows("Edit step"); }, "the warning");
  viewer_->click("Edit step");
  const TransplantTool& transplant = viewer_->app().document()->transplant;
  viewer_->wait_for([&] { return transplant.is_open(); }, "the transplant opens again");
  EXPECT_EQ(transplant.taken_up(), 0U);
}

TEST_F(Guides, AWarningOfATransplantPreviewSetsATransitionThatFits) {
  write_mesh(rippled_cylinder(96, 161), folder_ / "tube.obj");
  const Mesh whole = lapwing::test::finger(24, 60, 0.2, 0.6);
  write_mesh(lapwing::test::with_hole(whole, {0.2, 0.0, 0.05}, 0.02),
             folder_ / "data/lapwing/parts/finger.ply");
  start();
  place_part();
  viewer_->wait_for([&] { return viewer_->shows("Set transition width"); }, "the preview warns");
  const TransplantTool& transplant = viewer_->app().document()->transplant;
  ASSERT_TRUE(transplant.preview().result());
  const double narrowed =
      transplant.preview().result()->carried_out.report.transplant->transition_width;
  viewer_->click("Set transition width");
  viewer_->wait_for([&] { return transplant.preview().result() != nullptr; }, "another preview");
  EXPECT_FALSE(viewer_->shows("Set transition width"));
  const auto& transition = transplant.tool().draft().parameters.transition;
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->width, narrowed);
}

TEST_F(Guides, AWarningOfATransplantPreviewEnlargesTheHole) {
  place_part();
  viewer_->wait_for([&] { return viewer_->shows("Enlarge hole"); }, "the preview warns");
  const TransplantTool& transplant = viewer_->app().document()->transplant;
  const double share = transplant.tool().draft().hole_share;
  ASSERT_TRUE(transplant.preview().result());
  const std::size_t rim = transplant.preview().result()->carried_out.report.transplant->host_loop;
  viewer_->click("Enlarge hole");
  EXPECT_DOUBLE_EQ(transplant.tool().draft().hole_share, 1.5 * share);
  viewer_->wait_for([&] { return transplant.preview().result() != nullptr; }, "another preview");
  EXPECT_GT(transplant.preview().result()->carried_out.report.transplant->host_loop, rim);
}

TEST_F(Guides, AWarningOfACoatPreviewNegatesTheAmplitude) {
  Mesh inward = icosphere(3);
  std::vector<Index> faces(inward.face_count());
  std::iota(faces.begin(), faces.end(), 0U);
  flip_faces(inward, faces);
  write_mesh(inward, folder_ / "inward.obj");
  viewer_->key('K', kControl);
  viewer_->wait_for([&] { return viewer_->says("Source: "); }, "the coat begins");
  choose_roi();
  auto& desk = const_cast<DetailTransferTool&>(viewer_->app().document()->desk);
  desk.use_source(0, folder_ / "inward.obj");
  viewer_->wait_for([&] { return desk.view() != nullptr && !desk.is_reading(); },
                    "the source is read");
  drag_disk_of_source();
  viewer_->wait_for([&] { return viewer_->shows("Negate amplitude"); }, "the preview warns");
  viewer_->click("Negate amplitude");
  EXPECT_FALSE(viewer_->shows("Negate amplitude"));
  EXPECT_EQ(desk.draft().sources[0].amplitude, -1.0);
}

TEST_F(Guides, ReturnToTheRegionAfterACoatOrMix) {
  const Document& document = *viewer_->app().document();
  for (const int key : {static_cast<int>('K'), static_cast<int>('M')}) {
    viewer_->key(key, kControl);
    viewer_->wait_for([&] { return viewer_->says("ource: "); }, "the source is there");
    choose_roi();
    for (std::size_t k = 0; k < document.desk.draft().source_count(); ++k) {
      if (k > 0) viewer_->key('K', {.shift = true});
      drag_disk_of_source();
    }
    viewer_->key('M');
    ASSERT_EQ(document.editor.tool().row()->action, Action::take_move);
    viewer_->key(kEnter, kControl);
    viewer_->wait_for([&] { return !document.desk.is_open(); }, "the step is applied");
    EXPECT_EQ(document.editor.tool().row()->action, Action::take_disk);
    EXPECT_EQ(document.editor.tool().part().role, Part::Role::roi);
  }
  EXPECT_EQ(document.editor.state().steps.size(), 2U);
}

TEST_F(Guides, SayThatNothingHoldsTheSurface) {
  write_mesh(icosphere(3), folder_ / "ball.obj");
  viewer_->open(folder_ / "ball.obj");
  viewer_->wait_for([&] { return viewer_->says("642 vertices"); }, "the ball is open");
  viewer_->key('A', kControl);
  drag_disk(20.0);
  expect_says("Nothing holds the surface");
  // The progress bar would move the button.
  viewer_->wait_for(
      [&] {
        using Phase = PreparationStatus::Phase;
        const EditSession& session = viewer_->app().document()->editor.session();
        const Phase phase = session.preparation().status().phase;
        return phase == Phase::ready || phase == Phase::failed;
      },
      "it is prepared");
  viewer_->click("Select fixed border");
  EXPECT_EQ(viewer_->app().document()->editor.tool().part().role, Part::Role::belt);
  viewer_->key('A', kControl);
  viewer_->look_at();
  EXPECT_FALSE(viewer_->says("Nothing holds the surface"));
}

TEST_F(Guides, NameTheStepAtUndoAndRedo) {
  choose_roi();
  expect_at("Undo", "Undo: Region: disk");
  viewer_->key('Z', kControl);
  expect_at("Redo", "Redo: Region: disk");
}

TEST_F(Guides, SayThatACutNeedsARegionAndAName) {
  viewer_->click("Transplant");
  viewer_->click("More parts");
  expect_says("Select a region to cut out.");
  choose_roi();
  expect_says("Type a name for the part.");
}

TEST_F(Guides, SayThatACutWaitsForTheLastMove) {
  viewer_->key('I');
  drag_disk(60.0);
  viewer_->key('H');
  drag_disk(15.0);
  viewer_->click("Transplant");
  viewer_->click("More parts");
  // Cancels at once, because a result would end the message.
  auto& editor = const_cast<Editor&>(viewer_->app().document()->editor);
  editor.actions().perform(MoveHandle{0, SimilarityMove{.translate = {1.0, 0.0, 0.0}}});
  editor.session().cancel_settling();
  expect_says("The last move is not refined yet.");
  viewer_->key('Z', kControl);
  expect_says("Type a name for the part.");
}

TEST_F(Guides, EnterCutsOutTheNamedPart) {
  viewer_->click("Transplant");
  viewer_->click("More parts");
  choose_roi();
  const ImVec2 cut = find_text(viewer_->look_at(), "Cut")->middle();
  const Eigen::Vector2d field(cut.x - 80.0, cut.y);
  for (const InputKind kind : {InputKind::move, InputKind::press, InputKind::release}) {
    viewer_->send({.kind = kind, .position = field, .button = MouseButton::left});
  }
  type_line("rib");
  viewer_->wait_for([&] { return viewer_->shows("rib"); }, "the part");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "data/lapwing/parts/rib.obj"));
}

TEST_F(Guides, ShowFilesInTheHomeFolderWithATilde) {
  std::filesystem::remove(folder_ / "data/lapwing/parts/finger.ply");
  start();
  viewer_->click("Transplant");
  expect_says("~/data/lapwing/parts");
  viewer_->key('N');
  viewer_->wait_for([&] { return viewer_->says("There is no part in ~/data"); }, "the message");
}

TEST_F(Guides, EscapeCancelsACoat) {
  viewer_->key('K', kControl);
  const DetailTransferTool& desk = viewer_->app().document()->desk;
  viewer_->wait_for([&] { return viewer_->says("Source: "); }, "the coat begins");
  viewer_->key('K');
  ASSERT_NE(desk.picking(), DetailTransferTool::Picking::none);
  viewer_->key(kEscape);
  EXPECT_EQ(desk.picking(), DetailTransferTool::Picking::none);
  EXPECT_TRUE(desk.is_open());
  viewer_->key(kEscape);
  EXPECT_FALSE(desk.is_open());
}

TEST_F(Guides, AnErrorGoesAwayWithItsCause) {
  viewer_->key('K', kControl);
  viewer_->wait_for([&] { return viewer_->says("Source: "); }, "the coat begins");
  viewer_->click("Use whole source");
  viewer_->key(kEnter, kControl);
  const auto says_error = [&] { return viewer_->shows("Close"); };
  viewer_->wait_for(says_error, "the error is said");
  choose_roi();
  viewer_->look_at();
  EXPECT_FALSE(says_error());
}

TEST_F(Guides, ANumberMayHaveAnExponent) {
  choose_roi();
  viewer_->key('H');
  drag_disk(20.0);
  viewer_->key('M');
  viewer_->click("Selection");
  viewer_->click("0?");  // the reader of the screen knows no degree sign
  type_line("1e-3");
  const AppState& state = viewer_->app().document()->editor.state();
  EXPECT_DOUBLE_EQ(turn_of(state.moves.at(0).move).degrees, 1e-3);
}

TEST_F(Guides, AScaleIsTypedForEachAxis) {
  choose_roi();
  viewer_->key('H');
  drag_disk(20.0);
  viewer_->key('M');
  viewer_->click("Selection");
  // The field is to the right of the last Z. The rows of the translation and of the rotation axis
  // contain a Z, too.
  const auto axis = find_text(viewer_->look_at(), "Z");
  ASSERT_TRUE(axis);
  const Eigen::Vector2d field(axis->max.x + 30.0F, axis->middle().y);
  for (const InputKind kind : {InputKind::move, InputKind::press, InputKind::release}) {
    const bool is_move = kind == InputKind::move;
    viewer_->send({.kind = kind,
                   .position = field,
                   .button = is_move ? MouseButton::none : MouseButton::left});
  }
  viewer_->send({.kind = InputKind::key, .modifiers = kControl, .key = 'A'});
  type_line("2");
  const Move& move = viewer_->app().document()->editor.state().moves.at(0).move;
  ASSERT_TRUE(std::holds_alternative<SimilarityMove>(move));
  EXPECT_EQ(std::get<SimilarityMove>(move).scale, Eigen::Vector3d(1.0, 1.0, 2.0));
}

TEST_F(Guides, TheTitleFollowsSaveAs) {
  const Environment no_programs("PATH", "");  // no dialogs of the desktop
  viewer_->key('S', kControlShift);
  viewer_->wait_for([&] { return viewer_->shows("Save") && viewer_->shows("Cancel"); },
                    "the browser is there");
  viewer_->click("Save");
  viewer_->wait_for([&] { return viewer_->says("Saved ~/tube-edited.obj"); }, "it is saved");
  EXPECT_EQ(viewer_->app().title(), "tube-edited.obj - Lapwing");
}

}  // namespace
}  // namespace lapwing::viewer::test
