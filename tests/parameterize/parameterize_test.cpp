// A parameterization as a function of a mesh and a request.
#include "lapwing/parameterize/parameterize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/compact.h"
#include "parameterize/test_patches.h"
#include "support/cancel_everywhere.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::placed;
using test::PlacedPatch;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

ParameterizeRequest of_the_middle() {
  ParameterizeRequest request;
  request.region = {Box{{0.6, 0.5, -9.0}, {2.4, 1.9, 9.0}}, "the middle"};
  return request;
}

TEST(Parameterize, PutsTheMapsPointsOnTheMesh) {
  const Mesh mesh = test::hills();
  ParameterizeRequest request;
  for (const Domain domain : {Domain::disk, Domain::square}) {
    request.domain = domain;
    const Parameterized laid = parameterize(mesh, request);
    ASSERT_EQ(laid.mesh.attributes().corner_uvs.size(), mesh.face_vertices().size());
    for (std::size_t c = 0; c < mesh.face_vertices().size(); ++c) {
      const Index own = laid.patch.own_number(mesh.face_vertices()[c]);
      const Eigen::Vector2d uv = laid.mesh.attributes().uvs[laid.mesh.attributes().corner_uvs[c]];
      const Eigen::Vector2d point =
          domain == Domain::square ? uv : Eigen::Vector2d(2.0 * uv - Eigen::Vector2d(1, 1));
      EXPECT_LT((point - laid.map.points[own]).norm(), 1e-15);
    }
    EXPECT_EQ(laid.map.domain, domain);
    EXPECT_EQ(laid.mesh.positions, mesh.positions);
    EXPECT_THAT(laid.flipped, IsEmpty());
    EXPECT_THAT(laid.warnings, IsEmpty());
  }
}

TEST(Parameterize, IsTheMapOfThePatchByItsDefaultPins) {
  const Mesh mesh = test::hills();
  const test::PlacedPatch patch = test::placed(mesh);
  const Parameterized laid = parameterize(mesh, {});
  EXPECT_EQ(laid.pins, default_pins(patch.patch, patch.positions, Domain::disk));
  EXPECT_EQ(laid.map.points, patch.map(Domain::disk).points);
  EXPECT_EQ(laid.positions, patch.positions);
  const MapDistortion distortion =
      measure_distortion(patch.patch.triangles, patch.positions, laid.map.points);
  EXPECT_EQ(laid.distortion.stretch, distortion.stretch);
  EXPECT_EQ(laid.distortion.largest_shear, distortion.largest_shear);
}

TEST(Parameterize, GivesTextureCoordinatesInsideTheRegionOnly) {
  const Mesh mesh = test::hills();
  const Parameterized laid = parameterize(mesh, of_the_middle());
  const auto is_in_patch = [&](Index v) {
    return v >= mesh.vertex_count() || laid.patch.own_number(v) != kNoIndex;  // midpoints are
  };
  std::size_t outside = 0;
  for (std::size_t f = 0; f < laid.mesh.face_count(); ++f) {
    const bool is_inside = std::ranges::all_of(laid.mesh.face(f), is_in_patch);
    for (Index c = laid.mesh.face_starts()[f]; c < laid.mesh.face_starts()[f + 1]; ++c) {
      EXPECT_EQ(laid.mesh.attributes().corner_uvs[c] != kNoIndex, is_inside) << "face " << f;
    }
    outside += is_inside ? 0 : 1;
  }
  EXPECT_EQ(laid.mesh.face_count() - outside, laid.patch.triangles.size());
  EXPECT_GT(outside, 0U);
}

TEST(Parameterize, PinsAreVerticesOfTheMesh) {
  const Mesh mesh = test::hills();
  ParameterizeRequest request = of_the_middle();
  const Patch patch = parameterize(mesh, request).patch;
  for (const std::size_t at : {std::size_t{0}, patch.loop.size() / 2}) {
    const Index own = patch.loop[at];
    request.pins = {patch.vertices[own]};
    const Parameterized laid = parameterize(mesh, request);
    EXPECT_THAT(laid.pins, ElementsAre(own));
    EXPECT_LT((laid.map.points[own] - Eigen::Vector2d(1, 0)).norm(), 1e-12);
  }
}

TEST(Parameterize, NamesAPinThatIsNotInThePatch) {
  const Mesh mesh = test::hills();
  ParameterizeRequest request = of_the_middle();
  const Patch patch = parameterize(mesh, request).patch;
  request.pins = {0};
  EXPECT_THAT(error_message<InputError>([&] { parameterize(mesh, request); }),
              AllOf(StartsWith("parameterize: vertex 0 is not in the patch"),
                    HasSubstr("vertex " + std::to_string(patch.vertices[patch.loop.front()]))));
  request.where = "the pin";
  EXPECT_THAT(error_message<InputError>([&] { parameterize(mesh, request); }),
              StartsWith("the pin: vertex 0"));
  request.domain = Domain::square;
  request.pins = {patch.vertices[patch.loop.front()]};
  EXPECT_THAT(error_message<InputError>([&] { parameterize(mesh, request); }),
              HasSubstr("the square needs 4 pinned boundary vertices"));
}

TEST(Parameterize, NamesARegionThatIsNoDisk) {
  ParameterizeRequest request;
  request.region.where = "the tube";
  const Mesh tube = cylinder(12, 8, 1.0, 6.0);
  EXPECT_THAT(error_message<InputError>([&] { parameterize(tube, request); }),
              AllOf(StartsWith("the tube: "), HasSubstr("2 boundary loops")));
}

// A long closed tube on a short foot: at its tip the map is finer than its coordinates' rounding.
TEST(Parameterize, WarnsOfFlippedTriangles) {
  Mesh stalk = cylinder(12, 120, 1.0, 120.0);
  const auto tip = static_cast<Index>(stalk.vertex_count());
  stalk.positions.emplace_back(0, 0, 121);
  for (Index k = 0; k < 12; ++k) {
    stalk.add_face(std::array<Index, 3>{tip - 12 + k, tip - 12 + (k + 1) % 12, tip});
  }
  const Parameterized laid = parameterize(stalk, {});
  ASSERT_FALSE(laid.flipped.empty());
  const Index first = laid.patch.triangle_sources[laid.flipped.front()];
  EXPECT_THAT(laid.warnings, ElementsAre(AllOf(StartsWith("the map shrinks some triangles"),
                                               HasSubstr("triangle " + std::to_string(first)))));
}

TEST(Parameterize, CanBeCancelledEverywhere) {
  const Mesh mesh = test::hills();
  const auto whole = parameterize(mesh, {}).map.points;
  std::vector<Eigen::Vector2d> done;
  EXPECT_GT(test::cancel_everywhere([&](const Progress& progress) {
              done = parameterize(mesh, {}, progress).map.points;
            }),
            10U);
  EXPECT_EQ(done, whole);
}

Mesh with_map(const Mesh& mesh, const PlacedPatch& patch, const DomainMap& map) {
  Mesh result = with_uvs(mesh, patch.patch, map.points);
  EXPECT_NO_THROW(validate_attributes(result));
  EXPECT_NO_THROW(validate_indices(result));
  return result;
}

TEST(UvMesh, CornersOfThePatchHaveTheirPlaceAndOthersNone) {
  const Mesh mesh = icosphere(3);
  const PlacedPatch patch = placed(mesh, {GeodesicDisk{Index{17}, 0.7}, "region"});
  const DomainMap map = patch.map(Domain::disk);
  const Mesh result = with_map(mesh, patch, map);
  EXPECT_EQ(result.positions, mesh.positions);
  EXPECT_EQ(result.face_vertices(), mesh.face_vertices());
  std::vector<char> in_patch(mesh.face_count(), 0);
  for (const Index t : patch.patch.triangle_sources) in_patch[t] = 1;
  for (std::size_t c = 0; c < mesh.face_vertices().size(); ++c) {
    const Index uv = result.attributes().corner_uvs[c];
    if (in_patch[c / 3] != 0) {
      EXPECT_EQ(uv, patch.patch.own_number(mesh.face_vertices()[c]));
    } else {
      EXPECT_EQ(uv, kNoIndex);
    }
  }
  EXPECT_EQ(result.attributes().uvs, map.points);
}

TEST(UvMesh, HalvedEdgesBecomeVerticesThatKeepTheShape) {
  // Two quads side by side: the edge between them, and both diagonals, join boundary vertices.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 1}};
  mesh.add_face(std::array<Index, 4>{0, 1, 4, 3});
  mesh.add_face(std::array<Index, 4>{1, 2, 5, 4});
  mesh.edit_attributes().face_colors = {{1, 0, 0, 1}, {0, 1, 0, 1}};
  mesh.edit_attributes().vertex_colors.assign(6, {0.5F, 0.5F, 0.5F, 1});
  const PlacedPatch patch = placed(mesh);
  const Mesh result = with_map(mesh, patch, patch.map(Domain::disk));
  EXPECT_EQ(result.vertex_count(), 6U + 3U);
  EXPECT_EQ(result.face_count(), patch.patch.triangles.size());
  for (std::size_t f = 0; f < result.face_count(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index uv = result.attributes().corner_uvs[3 * f + k];
      EXPECT_EQ(uv, patch.patch.triangles[f][k]);
      EXPECT_EQ(result.positions[result.face(f)[k]], patch.positions[uv]);
    }
    const bool is_first = result.attributes().face_colors[f] == mesh.attributes().face_colors[0];
    for (const Index v : result.face(f)) EXPECT_LE(result.positions[v].x(), is_first ? 1.0 : 2.0);
  }
}

TEST(UvMesh, PolygonOnTheEdgeOfThePatchHasNoCoordinates) {
  Mesh mesh;  // a quad of which the region holds one half, beside a triangle
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  mesh.add_face(std::array<Index, 4>{0, 1, 2, 3});
  mesh.add_face(std::array<Index, 3>{1, 4, 2});
  const PlacedPatch patch = placed(mesh, {ListedVertices{{0, 1, 2}}, "region"});
  const Mesh result = with_map(mesh, patch, patch.map(Domain::disk));
  EXPECT_EQ(result.face_starts(), mesh.face_starts());
  EXPECT_THAT(result.attributes().corner_uvs, Each(kNoIndex));
}

TEST(UvMesh, HalfOfAPolygonThatIsNotInThePatchStays) {
  Mesh mesh;  // the patch: half a quad and a triangle, joined over an edge that is halved
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  mesh.add_face(std::array<Index, 4>{0, 1, 2, 3});
  mesh.add_face(std::array<Index, 3>{1, 4, 2});
  const PlacedPatch patch = placed(mesh, {ListedVertices{{0, 1, 2, 4}}, "region"});
  const Mesh result = with_map(mesh, patch, patch.map(Domain::disk));
  EXPECT_EQ(result.vertex_count(), 6U);
  EXPECT_EQ(result.face_count(), 5U) << "four parts, and the other half of the quad";
  double area = 0.0;
  for (const Triangle& t : result.topology().triangles) {
    area += 0.5 * (result.positions[t[1]] - result.positions[t[0]])
                      .cross(result.positions[t[2]] - result.positions[t[0]])
                      .z();
  }
  EXPECT_DOUBLE_EQ(area, 1.5);
}

MapDistortion of_grid_scaled(double x, double y) {
  const Mesh mesh = test::moved(grid(5, 7));
  std::vector<Vector2d> points;
  for (const Vector3d& p : grid(5, 7).positions) points.emplace_back(x * p.x(), y * p.y());
  return measure_distortion(mesh.topology().triangles, mesh.positions, points);
}

TEST(MapDistortion, IsOneForSimilarities) {
  for (const double scale : {1.0, 0.01, 300.0}) {
    const MapDistortion distortion = of_grid_scaled(scale, -scale);
    EXPECT_NEAR(distortion.stretch, 1.0, 1e-10);
    EXPECT_NEAR(distortion.largest_stretch, 1.0, 1e-10);
    EXPECT_NEAR(distortion.largest_shear, 1.0, 1e-4) << "the root of a rounding error";
  }
}

// Lengths grow by 1/2 and by 1, areas by 1/2: stretch sqrt((1/4 + 1) / 2) / sqrt(1/2).
TEST(MapDistortion, OfAnEvenStretchIsThatOfTheFormula) {
  const MapDistortion distortion = of_grid_scaled(2.0, 1.0);
  EXPECT_NEAR(distortion.stretch, std::sqrt(1.25), 1e-9);
  EXPECT_NEAR(distortion.largest_stretch, std::sqrt(1.25), 1e-9);
  EXPECT_NEAR(distortion.shear, 2.0, 1e-9);
  EXPECT_NEAR(distortion.largest_shear, 2.0, 1e-9);
}

TEST(MapDistortion, LeavesOutWhatHasNoArea) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {1, 3, 2}};
  const std::vector<Vector3d> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const std::vector<Vector2d> points{{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}};
  const MapDistortion distortion = measure_distortion(triangles, positions, points);
  EXPECT_NEAR(distortion.stretch, 1.0, 1e-12);
  EXPECT_EQ(measure_distortion({}, {}, {}).stretch, 1.0);
}

}  // namespace
}  // namespace lapwing
