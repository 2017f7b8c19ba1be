// A parameterization as a function of a mesh and a request.
#include "lapwing/parameterize/parameterize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "parameterize/test_patches.h"
#include "support/cancel_everywhere.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
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

}  // namespace
}  // namespace lapwing
