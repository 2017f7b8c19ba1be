// Tests that mirrored edits give symmetric results.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deform/mirror_scenes.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using test::MirrorScene;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

MovedHandle lifted(const MirrorScene& scene, const RegionSpec& region) {
  return {region, SimilarityMove{.translate = scene.way(0.4, 1.0, 0.6)}};
}
MovedHandle turned(const MirrorScene& scene, const RegionSpec& region, double scale,
                   std::optional<Vector3d> pivot) {
  return {
      region,
      SimilarityMove{
          scene.way(0.3, 0.2, -0.4), {scene.way(1, 2, 3), 35.0}, Vector3d::Constant(scale), pivot}};
}

struct MirrorCase {
  const char* name;
  void (*fill)(const MirrorScene&, DeformRequest&);
};

constexpr MirrorCase kMirrorCases[] = {
    {"AHandleOffThePlane",
     [](const MirrorScene& s, DeformRequest& r) { r.handles = {lifted(s, s.side)}; }},
    {"AHandleAcrossThePlane",
     [](const MirrorScene& s, DeformRequest& r) { r.handles = {lifted(s, s.across)}; }},
    {"BothHandles",
     [](const MirrorScene& s, DeformRequest& r) {
       r.handles = {turned(s, s.across, 1.1, std::nullopt), turned(s, s.side, 1.0, std::nullopt)};
     }},
    {"ATurnAboutAPivot",
     [](const MirrorScene& s, DeformRequest& r) {
       r.handles = {turned(s, s.side, 1.0, Vector3d(s.mesh.positions[s.side_vertex]))};
     }},
    {"AMatrix",
     [](const MirrorScene& s, DeformRequest& r) {
       MatrixMove move;
       move.matrix << 1.1, 0.2, 0, 0, -0.1, 1, 0.1, 0, 0, 0.1, 0.9, 0;
       const Vector3d center = s.mesh.positions[s.side_vertex];
       move.matrix.col(3) = center - move.matrix.leftCols<3>() * center + s.way(0.2, 0.3, 0.4);
       r.handles = {{s.side, move}, {s.across, move}};
     }},
    {"ABeltByFraction",
     [](const MirrorScene& s, DeformRequest& r) {
       r.belt = BoundaryAnchors{0.2, "belt"};
       r.handles = {lifted(s, s.side), lifted(s, s.across)};
     }},
    {"TargetsOffThePlane",
     [](const MirrorScene& s, DeformRequest& r) {
       const Vector3d& p = s.mesh.positions[s.side_vertex];
       const Triangle& t =
           s.mesh.topology().triangles[s.mesh.topology().vertex_triangles[s.side_vertex][0]];
       const Vector3d q =
           (p + s.mesh.positions[t[0]] + s.mesh.positions[t[1]] + s.mesh.positions[t[2]]) / 4.0;
       r.targets.rows = {{s.side_vertex, p + s.way(0.2, 0.3, 0.4), 3.0},
                         {q, q + s.way(0.1, -0.2, 0.4)}};
     }},
    {"HardTargetsOnBothSidesAndThePlane",
     [](const MirrorScene& s, DeformRequest& r) {
       r.targets.hard = true;
       for (const Index v : {s.side_vertex, s.plane_vertex}) {
         r.targets.rows.push_back({v, s.mesh.positions[v] + s.way(0.2, 0.3, 0.4)});
       }
       r.handles = {lifted(s, s.side)};
     }},
    {"HardHandles",
     [](const MirrorScene& s, DeformRequest& r) {
       r.parameters.hard = true;
       r.handles = {turned(s, s.side, 1.0, std::nullopt), lifted(s, s.across)};
     }},
    {"AFalloffThatMeetsItsImage",
     [](const MirrorScene& s, DeformRequest& r) {
       r.handles = {lifted(s, s.side)};
       r.handles[0].falloff.transition = Transition{0.4 * s.diagonal()};
     }},
    {"AFalloffOfHardHandles",
     [](const MirrorScene& s, DeformRequest& r) {
       r.parameters.hard = true;
       r.handles = {lifted(s, s.side), lifted(s, s.across)};
       r.handles[0].falloff = r.handles[1].falloff = {
           2.0, Transition{0.1 * s.diagonal(), Transition::Profile::linear}};
     }},
    {"APaintedFieldOverAll",
     [](const MirrorScene& s, DeformRequest& r) {
       // Painted around a vertex, over the plane and beyond.
       r.handles = {lifted(s, {DifferenceRegion{{s.roi, s.belt}}})};
       for (const Vector3d& p : s.mesh.positions) {
         const double d = (p - s.mesh.positions[s.side_vertex]).norm() / s.diagonal();
         r.handles[0].falloff.field.push_back(std::clamp(1.1 - 2.0 * d, 0.0, 1.0));
       }
     }},
    {"APaintedFieldAcrossThePlane",
     [](const MirrorScene& s, DeformRequest& r) {
       r.handles = {lifted(s, {DifferenceRegion{{s.roi, s.belt}}})};
       for (const Vector3d& p : s.mesh.positions) {
         const double d = (p - s.mesh.positions[s.plane_vertex] - s.way(0.2, 0, 0)).norm();
         r.handles[0].falloff.field.push_back(std::clamp(1.2 - 4.0 * d / s.diagonal(), 0.0, 1.0));
       }
     }},
    {"ALargeTurnInParts",
     [](const MirrorScene& s, DeformRequest& r) {
       r.handles = {{s.side, SimilarityMove{{0, 0, 0}, {s.way(1, 2, 3), 100.0}}}};
       r.parameters.commit_every = 50.0;
     }},
    {"TheLinearPaperSystem",
     [](const MirrorScene& s, DeformRequest& r) {
       r.parameters.response = LinearResponse::rsi;
       r.handles = {lifted(s, s.side), turned(s, s.across, 1.2, std::nullopt)};
     }},
};

void PrintTo(const MirrorCase& edit, std::ostream* out) {
  *out << edit.name;
}

struct NamedScene {
  const char* name;
  MirrorScene (*make)();
};
void PrintTo(const NamedScene& scene, std::ostream* out) {
  *out << scene.name;
}

class MirroredEdit : public ::testing::TestWithParam<std::tuple<MirrorCase, NamedScene, bool>> {};

TEST_P(MirroredEdit, IsSymmetric) {
  const auto& [edit, named, settle] = GetParam();
  const MirrorScene scene = named.make();
  ASSERT_LT(test::asymmetry(scene, scene.mesh.positions), 1e-15);
  DeformRequest request = scene.request();
  edit.fill(scene, request);
  if (!settle) request.parameters.settle.reset();
  const Deformed deformed = deform(scene.mesh, request);
  double moved = 0.0;
  for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
    moved = std::max(moved, (deformed.mesh.positions[v] - scene.mesh.positions[v]).norm());
  }
  EXPECT_GT(moved, 0.02 * scene.diagonal());
  // Settling ends when the remaining motion is about 1e-4 edge lengths.
  EXPECT_LT(test::asymmetry(scene, deformed.mesh.positions), settle ? 3e-6 : 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Scenes, MirroredEdit,
                         ::testing::Combine(::testing::ValuesIn(kMirrorCases),
                                            ::testing::Values(NamedScene{"Sheet",
                                                                         test::sheet_scene},
                                                              NamedScene{"Tube", test::tube_scene},
                                                              NamedScene{"Ball", test::ball_scene}),
                                            ::testing::Bool()),
                         [](const auto& with) {
                           return std::string(std::get<0>(with.param).name) + "Of" +
                                  std::get<1>(with.param).name +
                                  (std::get<2>(with.param) ? "Settled" : "Linear");
                         });

class AMirroredDeform : public ::testing::Test {
 protected:
  AMirroredDeform() { request_.handles = {lifted(scene_, scene_.side)}; }
  Deformed done() const { return deform(scene_.mesh, request_); }
  std::string error() const {
    return error_message<InputError>([&] { done(); });
  }
  VertexSet image(const VertexSet& set) const {
    return mirrored(set, mirror_images(scene_.mesh, scene_.plane, "mirror"));
  }

  MirrorScene scene_ = test::sheet_scene();
  DeformRequest request_ = scene_.request();
};

TEST_F(AMirroredDeform, HasEveryPartAndItsImage) {
  request_.belt = RegionSpec{ListedVertices{{0, 1, 21}}, "belt"};
  request_.roi = {DifferenceRegion{{{AllVertices{}}, {ListedVertices{{440}}}}}, "roi"};
  const EditRegion region = done().region;
  EXPECT_EQ(region.roi.size(), 441U) << "of vertex 440 the image is chosen, and so is 440";
  EXPECT_THAT(region.belt, ElementsAre(0, 1, 19, 20, 21, 41));
  ASSERT_EQ(region.handles.size(), 2U);
  EXPECT_EQ(region.handles[1], image(region.handles[0]));
}

TEST_F(AMirroredDeform, IsTheEditThatNamesBothHandles) {
  const Positions mirrored_positions = done().mesh.positions;
  const MovedHandle one = request_.handles[0];
  request_.mirror.reset();
  request_.handles.push_back({{ListedVertices{image(resolve(one.region, scene_.mesh))}},
                              mirror_image(one.move, scene_.plane)});
  EXPECT_EQ(done().mesh.positions, mirrored_positions);
}

TEST_F(AMirroredDeform, MovesAHandleAcrossThePlaneAlongItOnly) {
  request_.parameters.hard = true;
  request_.handles = {lifted(scene_, scene_.across)};
  const Vector3d asked = std::get<SimilarityMove>(request_.handles[0].move).translate;
  const Deformed deformed = done();
  ASSERT_EQ(deformed.region.handles.size(), 1U);
  EXPECT_EQ(deformed.region.handles[0], image(deformed.region.handles[0]));
  for (const Index v : deformed.region.handles[0]) {
    const Vector3d moved = deformed.mesh.positions[v] - scene_.mesh.positions[v];
    EXPECT_LT((moved - Vector3d(0, asked.y(), asked.z())).norm(), 1e-12);
  }
}

TEST_F(AMirroredDeform, ReachesTheImageOfAHardTarget) {
  const Index v = scene_.side_vertex;
  request_.targets = {.rows = {{v, scene_.mesh.positions[v] + Vector3d(0.1, 0, 0.1)}},
                      .hard = true};
  const Deformed deformed = done();
  ASSERT_EQ(deformed.region.targets.size(), 2U);
  const Index w = deformed.region.targets[1].corners[0];
  EXPECT_NEAR(scene_.mesh.positions[w].x(), 1.0 - scene_.mesh.positions[v].x(), 1e-15);
  const Vector3d there = scene_.mesh.positions[w] + Vector3d(-0.1, 0, 0.1);
  EXPECT_LT((deformed.mesh.positions[w] - there).norm(), 1e-15);
}

TEST_F(AMirroredDeform, ProjectsATargetOfThePlane) {
  request_.targets.hard = true;
  const Index v = scene_.plane_vertex;
  const Vector3d& p = scene_.mesh.positions[v];
  for (const bool by_place : {false, true}) {
    request_.targets.rows = {{v, p + Vector3d(0.1, 0, 0.1)}};
    if (by_place) request_.targets.rows[0].point = p;
    const Deformed deformed = done();
    ASSERT_EQ(deformed.region.targets.size(), 1U);
    EXPECT_EQ(deformed.mesh.positions[v], p + Vector3d(0, 0, 0.1));
  }
}

TEST_F(AMirroredDeform, NamesTheRowWhoseImageDoesNotFit) {
  const Index v = scene_.side_vertex;
  const Index w = image({v}).front();
  const Vector3d up(0, 0, 0.1);
  request_.targets.rows = {{v, scene_.mesh.positions[v] + up}, {w, scene_.mesh.positions[w] - up}};
  EXPECT_EQ(error(), "targets: row 0 (its mirror image): vertex " + std::to_string(w) +
                         " has another position in row 1. Remove one of the two rows");
}

TEST_F(AMirroredDeform, SaysWhichPlaneItIs) {
  EXPECT_THAT(done().notes, ElementsAre(HasSubstr("deform: mirrored; the mesh is symmetric")));
  EXPECT_THAT(done().warnings, IsEmpty());
  request_.mirror->plane = AutomaticMirror{};
  EXPECT_THAT(done().notes,
              ElementsAre(::testing::AllOf(HasSubstr("mirrored in the plane through (0.5,"),
                                           HasSubstr("found from the shape"))));
  request_.mirror->plane = MirrorPlane{{0.3, 0, 0}, {1, 0, 0}};
  request_.handles = {{test::disk({0.1, 0.75, 0}, 0.1), SimilarityMove{.translate = {0, 0, 0.1}}}};
  EXPECT_THAT(done().notes,
              ElementsAre(HasSubstr("That is large: make sure that this is its plane of "
                                    "symmetry")));
}

TEST_F(AMirroredDeform, FindsThePlaneByItself) {
  for (const MirrorScene& scene : {test::sheet_scene(), test::tube_scene(), test::ball_scene()}) {
    const FoundMirror found = find_mirror_plane(scene.mesh, "mirror");
    EXPECT_LT(found.asymmetry, 1e-9);
  }
  const MirrorScene ball = test::ball_scene();
  const FoundMirror found = find_mirror_plane(ball.mesh, "mirror");
  DeformRequest request = ball.request();
  request.handles = {lifted(ball, ball.side)};
  request.mirror->plane = AutomaticMirror{};
  MirrorScene as_found = ball;
  as_found.plane = found.plane;
  EXPECT_LT(test::asymmetry(as_found, deform(ball.mesh, request).mesh.positions), 1e-8);
}

TEST_F(AMirroredDeform, TakesTheHandlesOfOneSideOnly) {
  const RegionSpec other{ListedVertices{image(resolve(scene_.side, scene_.mesh))}, "other"};
  request_.handles[0].region.where = "one";
  request_.handles.push_back(lifted(scene_, other));
  EXPECT_THAT(error(), ::testing::StartsWith("one: its mirror image contains vertex "));
  EXPECT_THAT(error(), HasSubstr("of handle 1; give the handles of one side only, or remove "
                                 "\"mirror\""));
}

TEST_F(AMirroredDeform, ThatCannotBeIsAnErrorWithItsPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  request_.mirror->plane = MirrorPlane{{0, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(error(), "mirror: the normal of the mirror plane is zero; give a direction");
  request_.mirror->plane = MirrorPlane{{0, 0, 0}, {0, nan, 0}};
  EXPECT_EQ(error(),
            "mirror: the normal of the mirror plane is not finite; give finite coordinates");
  request_.mirror->plane = MirrorPlane{{0, nan, 0}, {0, 1, 0}};
  EXPECT_EQ(error(),
            "mirror: the point of the mirror plane is not finite; give finite coordinates");
  request_.mirror->plane = MirrorPlane{{7, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(error(),
            "mirror: the mirror plane does not pass through the mesh; give a point of the "
            "plane, or \"auto\"");
  request_.mirror->plane = scene_.plane;
  request_.belt = RegionSpec{ListedVertices{image(resolve(scene_.side, scene_.mesh))}, "belt"};
  request_.handles[0].region.where = "handle";
  EXPECT_THAT(error(), ::testing::StartsWith("handle: the handle shares "));
  EXPECT_THAT(error(), HasSubstr("with the belt"));
}

// Whatever the length of the normal.
TEST_F(AMirroredDeform, TakesANormalOfAnyLength) {
  for (const double length : {1e-200, 1e-3, 1e200}) {
    const MirrorPlane plane{{0.5, 0, 0}, {length, 0, 0}};
    EXPECT_EQ(reflection(plane) * Vector3d(0.25, 1, 2), Vector3d(0.75, 1, 2)) << length;
  }
}

TEST_F(AMirroredDeform, OfPointsAloneIsAnError) {
  Mesh points;
  points.positions = scene_.mesh.positions;
  for (const std::variant<AutomaticMirror, MirrorPlane>& plane :
       {std::variant<AutomaticMirror, MirrorPlane>(AutomaticMirror{}),
        std::variant<AutomaticMirror, MirrorPlane>(scene_.plane)}) {
    request_.mirror->plane = plane;
    EXPECT_EQ(error_message<InputError>([&] { deform(points, request_); }),
              "mirror: the mesh has no triangles, so there is no surface to mirror");
  }
}

// A lone vertex has no image; the surface's have theirs.
TEST_F(AMirroredDeform, LeavesLoneVerticesAlone) {
  Mesh mesh = scene_.mesh;
  mesh.positions.emplace_back(0.1, 0.1, 3.0);
  const auto lone = static_cast<Index>(mesh.vertex_count() - 1);
  const auto images = mirror_images(mesh, scene_.plane, "mirror");
  EXPECT_EQ(images[lone], lone);
  EXPECT_EQ(images[0], 20U);
  request_.targets = {.rows = {{lone, {0.2, 0.2, 4.0}}}, .hard = true};
  const Deformed deformed = deform(mesh, request_);
  EXPECT_EQ(deformed.region.targets.size(), 1U);
  EXPECT_EQ(deformed.mesh.positions[lone], Vector3d(0.2, 0.2, 4.0));
}

TEST(MirrorImageOfAMove, IsTheMoveOfTheImage) {
  const MirrorPlane plane{{1, 2, 3}, {1, -2, 0.5}};
  const Affine3d mirror = reflection(plane);
  const Vector3d centroid(0.3, 0.5, -1);
  MatrixMove matrix;
  matrix.matrix << 1.1, 0.2, 0, 5, -0.1, 1, 0.1, 6, 0, 0.1, 0.9, 7;
  for (const Move& move :
       {Move(SimilarityMove{
            {1, 2, 3}, {{3, 1, 2}, 50.0}, Vector3d::Constant(1.5), Vector3d(4, 5, 6)}),
        Move(SimilarityMove{{1, 2, 3}, {{3, 1, 2}, 50.0}, Vector3d::Constant(0.5), std::nullopt}),
        Move(matrix)}) {
    const Affine3d image = to_affine(mirror_image(move, plane), mirror * centroid);
    const Affine3d expected = mirror * to_affine(move, centroid) * mirror;
    EXPECT_LT((image.matrix() - expected.matrix()).norm(), 1e-12);
    // The component of a move along the plane equals its mirror image.
    const Vector3d in_plane = 0.5 * (centroid + mirror * centroid);
    const Affine3d along = to_affine(along_mirror(move, plane), in_plane);
    EXPECT_LT((along.matrix() - (mirror * along * mirror).matrix()).norm(), 1e-12);
  }
}

TEST(MirrorImageOfAMove, ScalesAxesDifferentlyOnlyAcrossAPlaneAlongThem) {
  const Move move = SimilarityMove{{1, 2, 3}, {{3, 1, 2}, 50.0}, Vector3d(2, 1, 0.5), {}};
  const Vector3d centroid(0.3, 0.5, -1);
  const MirrorPlane across_y{{1, 2, 3}, {0, -2, 0}};
  const Affine3d mirror = reflection(across_y);
  const Affine3d image = to_affine(mirror_image(move, across_y), mirror * centroid);
  EXPECT_LT((image.matrix() - (mirror * to_affine(move, centroid) * mirror).matrix()).norm(),
            1e-12);
  const MirrorPlane tilted{{1, 2, 3}, {1, -2, 0.5}};
  EXPECT_THAT([&] { mirror_image(move, tilted); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("give the move as a \"matrix\"")));
}

}  // namespace
}  // namespace lapwing
