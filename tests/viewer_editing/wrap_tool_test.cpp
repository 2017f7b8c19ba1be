// Tests the tool of the Wrap tab, and the coat with the detail of its scan.
#include "editing/wrap_tool.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/gpu/context.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/gpu.h"
#include "viewer_state/test_view.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// A ball is the template, and an egg the scan, whose vertices correspond if their numbers are
// equal. Both views show them from the front.
class AWrap : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    for (Vector3d& p : egg_.positions) p = p.cwiseProduct(Vector3d(1.0, 1.2, 1.4));
    write_mesh(egg_, folder_ / "egg.ply");
    const AppState state = open_state(ball_);
    view_.camera = fit(ball_.positions, view_axes(View::three_quarter), kWindow.x() / kWindow.y());
    view_.size = kWindow;
    const auto context = std::make_shared<gpu::Context>();
    const auto say = [this](const Message& message) {
      if (!message.text.empty()) said_ = message.text;
    };
    editor_.emplace(EditStart{History(state), state.rest, {}, {}, folder_.path()}, context, say,
                    [] {});
    wrap_.emplace(UpAxis::y, context, say, [] {});
    coat_.emplace(UpAxis::y, context, say, [] {});
  }

  void update() {
    editor_->update();
    wrap_->update(*editor_);
    coat_->update(*editor_);
  }
  void update_until(const std::function<bool()>& happened) {
    wait_until([&] {
      update();
      return happened();
    });
  }
  void open_scan() {
    wrap_->open_scan(*editor_, folder_ / "egg.ply");
    update_until([&] { return wrap_->view() != nullptr; });
    wrap_->view()->resize(kWindow, 1.0);
  }
  // The vertex that a view shows in front of the others at the height z.
  static Index in_front(const Mesh& mesh, const ViewFrame& view, double z) {
    const Vector3d toward_eye = view.camera.eye.normalized();
    return static_cast<Index>(std::ranges::max_element(mesh.positions, {},
                                                       [&](const Vector3d& p) {
                                                         return p.dot(toward_eye) -
                                                                3.0 * std::abs(p.z() - z);
                                                       }) -
                              mesh.positions.begin());
  }
  void click_template(Index v) {
    const Positions& shown = editor_->view().positions();
    editor_->input().handle(press(*view_.projection().to_pixel(shown[v])), view_);
    wrap_->take_points(*editor_);
  }
  void click_scan(Index v) {
    const auto pixel = wrap_->view()->view_frame().projection().to_pixel(egg_.positions[v]);
    wrap_->view()->handle(press(*pixel), keymaps()[0]);
    wrap_->take_points(*editor_);
  }
  void write_rows(const std::string& name, const std::vector<std::pair<Index, Index>>& pairs) {
    std::ofstream file(folder_ / name);
    file << "vertex,x,y,z\n";
    for (const auto& [v, on_scan] : pairs) {
      file << v << ',' << egg_.positions[on_scan].format({17, 0, ",", ","}) << '\n';
    }
  }
  void load(const std::vector<std::pair<Index, Index>>& pairs) {
    write_rows("landmarks.csv", pairs);
    wrap_->load_landmarks(folder_ / "landmarks.csv");
    update();
  }
  void wrap() {
    wrap_->wrap(*editor_);
    update_until([&] { return wrap_->report() != nullptr || !wrap_->preview().message().empty(); });
    ASSERT_NE(wrap_->report(), nullptr) << wrap_->preview().message();
  }
  const WrapStep& last_step() { return std::get<WrapStep>(*editor_->state().steps.back()); }

  const Mesh ball_ = icosphere(3);
  Mesh egg_ = icosphere(3);
  TemporaryFolder folder_;
  ViewFrame view_;
  std::string said_;
  std::optional<Editor> editor_;
  std::optional<WrapTool> wrap_;
  std::optional<DetailTransferTool> coat_;
};

TEST_F(AWrap, PicksPairsOfPointsInEitherOrder) {
  open_scan();
  const Index a = in_front(ball_, view_, 0.5);
  const Index b = in_front(ball_, view_, 0.0);
  click_template(a);
  EXPECT_EQ(wrap_->picked_on_template(), a);
  click_scan(a);
  click_scan(b);
  EXPECT_THAT(wrap_->landmarks(), SizeIs(1));
  EXPECT_TRUE(wrap_->picked_on_scan());
  click_template(b);
  ASSERT_THAT(wrap_->landmarks(), SizeIs(2)) << said_;
  EXPECT_EQ(wrap_->landmarks()[0].corners[0], a);
  EXPECT_EQ(wrap_->landmarks()[1].corners[0], b);
  EXPECT_LT((wrap_->landmarks()[1].position - egg_.positions[b]).norm(), 0.02);
}

TEST_F(AWrap, DeletesAndMovesPairsAndUndoesThat) {
  open_scan();
  const Index a = in_front(ball_, view_, 0.5);
  const Index b = in_front(ball_, view_, 0.0);
  load({{a, a}, {b, b}});
  wrap_->remove(0);
  ASSERT_THAT(wrap_->landmarks(), SizeIs(1));
  EXPECT_EQ(wrap_->landmarks()[0].corners[0], b);
  EXPECT_TRUE(wrap_->undo());
  ASSERT_THAT(wrap_->landmarks(), SizeIs(2));
  wrap_->move(*editor_, 0);
  const Index c = in_front(ball_, view_, 0.25);
  click_template(c);
  EXPECT_EQ(wrap_->landmarks()[0].corners[0], c);
  EXPECT_EQ(wrap_->landmarks()[0].position, egg_.positions[a]) << "the point of the scan stays";
  EXPECT_TRUE(wrap_->undo());
  EXPECT_EQ(wrap_->landmarks()[0].corners[0], a);
  EXPECT_TRUE(wrap_->redo());
  EXPECT_EQ(wrap_->landmarks()[0].corners[0], c);
  EXPECT_FALSE(wrap_->redo());
}

TEST_F(AWrap, LoadsAndSavesLandmarks) {
  open_scan();
  load({{3, 3}, {50, 50}});
  ASSERT_THAT(wrap_->landmarks(), SizeIs(2));
  EXPECT_EQ(wrap_->landmarks()[1].position, egg_.positions[50]);
  wrap_->save_landmarks(folder_ / "saved.csv");
  std::vector<std::string> notes;
  const LandmarkSpec saved = with_rows({.file = folder_ / "saved.csv"}, {}, notes);
  EXPECT_THAT(saved.rows, ElementsAre(Landmark{Index{3}, egg_.positions[3]},
                                      Landmark{Index{50}, egg_.positions[50]}));
  std::ofstream(folder_ / "other.csv") << "vertex,x,y,z\n99999,0,0,0\n";
  wrap_->load_landmarks(folder_ / "other.csv");
  update();
  EXPECT_THAT(said_, HasSubstr("no vertex 99999"));
  EXPECT_THAT(wrap_->landmarks(), SizeIs(2)) << "they stay";
}

TEST_F(AWrap, RefusesTwoPlacesForOneVertex) {
  open_scan();
  const Index a = in_front(ball_, view_, 0.5);
  load({{a, a}});
  click_template(a);
  click_scan(in_front(ball_, view_, 0.0));
  EXPECT_THAT(said_, HasSubstr(std::to_string(a)));
  EXPECT_THAT(wrap_->landmarks(), SizeIs(1));
}

TEST_F(AWrap, IsShownWithItsDistancesAndAppliedAsOneStepWithItsLandmarks) {
  editor_->actions().perform(SetStiffness{{{{ListedVertices{{1, 2}}}, 10.0}}});
  open_scan();
  load({{3, 3}, {50, 50}, {100, 100}, {200, 200}});
  wrap();
  EXPECT_LT(wrap_->report()->to_scan.mean, 1e-3 * wrap_->report()->scan_diagonal);
  EXPECT_EQ(wrap_->report()->alignment.method, AlignmentMethod::landmarks);
  const ShownSurface& shown = editor_->view().shown();
  EXPECT_TRUE(shown.previews());
  EXPECT_TRUE(shown.is_measured());
  EXPECT_GT(shown.measure_range().high, 0.0F);
  EXPECT_THAT(editor_->state().steps, IsEmpty());
  const Positions wrapped = shown.positions();
  EXPECT_NEAR(bounds_of(wrapped).max.z(), 1.4, 0.02);
  wrap_->colors_by_distance = false;
  wrap_->show_colors(*editor_);
  EXPECT_FALSE(shown.is_measured());
  wrap_->apply(*editor_);
  update();
  ASSERT_THAT(editor_->state().steps, SizeIs(1));
  EXPECT_THAT(last_step().landmarks.rows, SizeIs(4));
  EXPECT_THAT(last_step().stiffness, SizeIs(1));
  EXPECT_EQ(editor_->view().positions(), wrapped);
  EXPECT_FALSE(wrap_->is_open());
  editor_->actions().undo();
  EXPECT_EQ(editor_->state().rest->positions, ball_.positions);
}

TEST_F(AWrap, IsNotAppliedAfterItsLandmarksHaveChanged) {
  open_scan();
  load({{3, 3}, {50, 50}, {100, 100}, {200, 200}});
  wrap();
  const Index a = in_front(ball_, view_, 0.5);
  click_template(a);  // on the result
  click_scan(a);
  ASSERT_THAT(wrap_->landmarks(), SizeIs(5));
  EXPECT_FALSE(wrap_->is_current(*editor_));
  wrap_->apply(*editor_);
  EXPECT_THAT(editor_->state().steps, IsEmpty());
  wrap();
  EXPECT_TRUE(wrap_->is_current(*editor_));
}

TEST_F(AWrap, SaysWhichLandmarkContradictsTheOthers) {
  open_scan();
  std::ofstream file(folder_ / "landmarks.csv");
  for (Index v = 0; v < 6; ++v) {
    const Vector3d on_scan = (v == 3 ? -1.5 : 1.0) * egg_.positions[v];
    file << v << ',' << on_scan.format({17, 0, ",", ","}) << '\n';
  }
  file.close();
  wrap_->load_landmarks(folder_ / "landmarks.csv");
  update();
  wrap();
  EXPECT_THAT(wrap_->report()->trouble, HasSubstr("landmark 4")) << wrap_->report()->edge_stretch;
  EXPECT_EQ(wrap_->report()->farthest_landmark, 3U);
}

TEST_F(AWrap, IsCancelledAndThenClosed) {
  open_scan();
  wrap_->wrap(*editor_);
  update();
  wrap_->cancel(*editor_);
  EXPECT_FALSE(wrap_->preview().status().busy);
  EXPECT_EQ(wrap_->report(), nullptr);
  EXPECT_TRUE(wrap_->is_open());
  EXPECT_EQ(editor_->view().positions(), ball_.positions);
  wrap();
  wrap_->wrap(*editor_);
  update();
  wrap_->cancel(*editor_);
  EXPECT_EQ(editor_->view().positions(), ball_.positions) << "not the result before";
  wrap_->cancel(*editor_);
  EXPECT_FALSE(wrap_->picks());
  EXPECT_TRUE(wrap_->is_open());
  wrap_->cancel(*editor_);
  EXPECT_FALSE(wrap_->is_open());
}

TEST_F(AWrap, IsOpenedAgainWithTheLandmarksAndSettingsWithWhichItWasClosed) {
  open_scan();
  load({{3, 3}, {50, 50}});
  wrap_->settings.hard = true;
  wrap_->close(*editor_);
  EXPECT_THAT(wrap_->landmarks(), IsEmpty());
  write_mesh(ball_, folder_ / "other.ply");
  wrap_->open_scan(*editor_, folder_ / "other.ply");
  EXPECT_THAT(wrap_->landmarks(), IsEmpty());
  EXPECT_FALSE(wrap_->settings.hard);
  open_scan();
  EXPECT_THAT(wrap_->landmarks(), IsEmpty()) << "the last wrap was onto the other scan";
  load({{3, 3}, {50, 50}, {100, 100}});
  wrap_->close(*editor_);
  open_scan();
  ASSERT_THAT(wrap_->landmarks(), SizeIs(3));
  EXPECT_EQ(wrap_->landmarks()[2].position, egg_.positions[100]);
}

TEST_F(AWrap, IsEditedAgain) {
  open_scan();
  load({{3, 3}, {50, 50}, {100, 100}, {200, 200}});
  wrap_->settings = {
      .aligned = true, .hard = true, .mirror = MirrorSpec{MirrorPlane{}}, .detail = true};
  wrap();
  wrap_->apply(*editor_);
  ASSERT_TRUE(wrap_->take_up(*editor_, 0));
  update_until([&] { return wrap_->landmarks().size() == 4; });
  wrap_->remove(3);
  wrap();
  wrap_->apply(*editor_);
  update_until([&] { return !editor_->session().is_carrying_out(); });
  ASSERT_THAT(editor_->state().steps, SizeIs(1));
  EXPECT_THAT(last_step().landmarks.rows, SizeIs(3));
  EXPECT_TRUE(last_step().aligned && last_step().hard && last_step().detail);
  EXPECT_EQ(last_step().mirror, MirrorSpec{MirrorPlane{}});
}

TEST_F(AWrap, TakesAPointCloudWithNormalsAsItsScan) {
  Mesh cloud;
  for (const Vector3d& p : icosphere(4).positions) {
    cloud.positions.push_back(p.cwiseProduct(Vector3d(1.0, 1.2, 1.4)));
    cloud.edit_attributes().normals.push_back(p.cwiseQuotient(Vector3d(1.0, 1.2, 1.4)));
  }
  write_mesh(cloud, folder_ / "egg.ply");
  open_scan();
  wrap_->settings.aligned = true;
  wrap_->wrap(*editor_);
  update_until([&] { return wrap_->report() != nullptr; });
  EXPECT_GT(wrap_->report()->coverage, 0.95);
}

TEST_F(AWrap, RefusesAPointCloudWithoutNormals) {
  Mesh cloud = egg_;
  cloud.edit_faces() = {};
  write_mesh(cloud, folder_ / "egg.ply");
  wrap_->open_scan(*editor_, folder_ / "egg.ply");
  update_until([&] { return !wrap_->is_reading(); });
  EXPECT_EQ(wrap_->view(), nullptr);
  EXPECT_THAT(said_, HasSubstr("normals"));
}

TEST_F(AWrap, OfAnotherMeshClosesWhenTheTrianglesChange) {
  open_scan();
  const auto fine = std::make_shared<const Mesh>(icosphere(1));
  editor_->actions().perform(Apply{SubdivideRequest{}, std::make_shared<const AppliedStep>(fine)});
  update();
  EXPECT_FALSE(wrap_->is_open());
}

// The patch and the pairs of the coat follow the region.
TEST_F(AWrap, TheCoatOfAScanTakesTheScanWhereItLies) {
  Mesh rough = icosphere(5);
  for (Vector3d& p : rough.positions) p *= 1.0 + 0.01 * std::sin(20.0 * p.x());
  write_mesh(rough, folder_ / "rough.ply");
  editor_->actions().perform(Choose{
      {Part::Role::roi}, {GeodesicDisk{.center = in_front(ball_, view_, 0.0), .radius = 1.2}}});
  coat_->begin(*editor_, LayerDraft::Operation::coat);
  coat_->use_source(0, folder_ / "rough.ply", true);
  update_until([&] { return coat_->preview().has_result(); });
  const CoatSource& source = coat_->draft().sources[0];
  ASSERT_THAT(source.inner_pairs, SizeIs(8));
  for (const auto& [from, to] : source.inner_pairs) {
    EXPECT_LT((rough.positions[from] - ball_.positions[to]).norm(), 0.05);
  }
  EXPECT_FALSE(coat_->view()->patch().vertices.empty());
  const Vector3d middle = ball_.positions[in_front(ball_, view_, 0.0)];
  for (const Index v : coat_->view()->patch().vertices) {
    EXPECT_LT((rough.positions[v] - middle).norm(), 1.2);
  }
}

}  // namespace
}  // namespace lapwing::viewer::test
