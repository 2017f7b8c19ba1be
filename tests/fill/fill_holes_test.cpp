#include "lapwing/fill/fill_holes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/broken_meshes.h"
#include "lapwing/base/errors.h"
#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"
#include "support/cancel_everywhere.h"

namespace lapwing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Removes the vertices for which `is_inside` holds.
template <class Predicate>
Mesh with_hole(Mesh mesh, const Predicate& is_inside) {
  KeepMask keep(mesh.vertex_count());
  std::ranges::transform(mesh.positions, keep.begin(),
                         [&](const Eigen::Vector3d& p) { return is_inside(p) ? 0 : 1; });
  keep_vertices(mesh, keep);
  return mesh;
}

// A unit sphere with a hole whose rim is `degrees` from the pole.
Mesh sphere_with_hole(double degrees) {
  const double lowest = std::cos(degrees * 3.14159265358979 / 180.0);
  return with_hole(icosphere(4), [&](const Eigen::Vector3d& p) { return p.z() > lowest; });
}

Mesh sheet_with_hole() {
  return with_hole(grid(12, 12), [](const Eigen::Vector3d& p) {
    return (p - Eigen::Vector3d(0.5, 0.5, 0.0)).norm() < 0.25;
  });
}

FilledHoles filled(const Mesh& mesh, FillShape shape) {
  return fill_holes(mesh, chosen(find_holes(mesh), {}), shape);
}

void expect_closed_manifold(const Mesh& mesh) {
  const CheckReport report = check(mesh);
  EXPECT_THAT(report.holes, IsEmpty());
  EXPECT_EQ(report.statistics.boundary_edges, 0U);
  for (const Defect& defect : report.defects) {
    if (describe(defect.kind).severity == Severity::info) continue;
    ADD_FAILURE() << defect.count << " " << describe(defect.kind).name;
  }
}

class EveryFill : public ::testing::TestWithParam<FillShape> {};

TEST_P(EveryFill, ClosesTheMeshWithOneOrientation) {
  expect_closed_manifold(filled(sphere_with_hole(30.0), GetParam()).mesh);
  expect_closed_manifold(filled(cylinder(12, 9, 1.0, 5.0), GetParam()).mesh);
}

TEST_P(EveryFill, KeepsVerticesAndFaces) {
  const Mesh mesh = sphere_with_hole(30.0);
  const FilledHoles result = filled(mesh, GetParam());
  EXPECT_EQ(result.holes, 1U);
  EXPECT_EQ(result.mesh.vertex_count(), mesh.vertex_count() + result.vertices);
  EXPECT_EQ(result.mesh.face_count(), mesh.face_count() + result.faces);
  EXPECT_TRUE(std::ranges::equal(mesh.positions,
                                 std::span(result.mesh.positions).first(mesh.vertex_count())));
}

TEST_P(EveryFill, APlaneHoleStaysPlaneAndIsCoveredOnce) {
  const Mesh result = filled(sheet_with_hole(), GetParam()).mesh;
  for (const Eigen::Vector3d& p : result.positions) EXPECT_NEAR(p.z(), 0.0, 1e-12);
  EXPECT_NEAR(check(result).statistics.area, 1.0, 1e-12);
}

TEST_P(EveryFill, ASingleMissingFaceComesBack) {
  Mesh mesh = icosphere(0);
  KeepMask keep(mesh.face_count(), 1);
  keep[3] = 0;
  keep_faces(mesh, keep);
  expect_closed_manifold(filled(mesh, GetParam()).mesh);
}

TEST_P(EveryFill, DiagonalsThatAreEdgesOfTheMeshAreSplit) {
  // Four vertices in a ring of two triangles; both diagonals of the hole are edges of the mesh.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}};
  add_polygon(mesh, {0, 1, 4});
  add_polygon(mesh, {1, 2, 4});
  add_polygon(mesh, {2, 3, 4});
  add_polygon(mesh, {3, 0, 4});
  add_polygon(mesh, {0, 2, 5});  // a fin on the diagonal
  std::vector<Hole> holes = find_holes(mesh);
  std::erase_if(holes, [](const Hole& hole) { return !hole.trouble.empty(); });
  for (const Hole& hole : holes) {
    const Mesh result = fill_holes(mesh, std::span(&hole, 1), GetParam()).mesh;
    EXPECT_EQ(check(result).find(DefectKind::non_manifold_edge), nullptr);
  }
}

TEST_P(EveryFill, CopiesAttributesFromTheRim) {
  Mesh mesh = sphere_with_hole(30.0);
  MeshAttributes& a = mesh.edit_attributes();
  a.vertex_colors.assign(mesh.vertex_count(), Eigen::Vector4f(0.25F, 0.5F, 0.75F, 1.0F));
  a.materials = {"skin"};
  a.face_materials.assign(mesh.face_count(), 0);
  a.uvs = {{0.0, 0.0}};
  a.corner_uvs.assign(mesh.face_vertices().size(), 0);
  a.normals = mesh.positions;
  a.has_vertex_normals = true;
  a.vertex_extras = {{"label", "int", 2, std::vector<double>(2 * mesh.vertex_count(), 7.0)}};
  const FilledHoles result = filled(mesh, GetParam());
  validate_attributes(result.mesh);
  const MeshAttributes& b = result.mesh.attributes();
  EXPECT_TRUE(b.vertex_colors.back().isApprox(Eigen::Vector4f(0.25F, 0.5F, 0.75F, 1.0F)));
  EXPECT_EQ(b.face_materials.back(), 0U);
  EXPECT_EQ(b.corner_uvs.back(), kNoIndex);
  EXPECT_EQ(b.vertex_extras[0].values.back(), 7.0);
  EXPECT_NEAR(b.normals.back().norm(), 1.0, 1e-6);
}

TEST_P(EveryFill, UnweldedSeamsStayAndTheSurfaceIsClosed) {
  const Mesh mesh = sphere_with_hole(30.0);
  Mesh soup;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto first = static_cast<Index>(soup.vertex_count());
    for (const Index v : mesh.face(f)) soup.positions.push_back(mesh.positions[v]);
    add_polygon(soup, {first, first + 1, first + 2});
  }
  const Mesh result = filled(soup, GetParam()).mesh;
  EXPECT_THAT(find_holes(result), IsEmpty());
}

TEST_P(EveryFill, GivesTheSameBitsAgain) {
  const Mesh mesh = sphere_with_hole(50.0);
  const Mesh once = filled(mesh, GetParam()).mesh;
  const Mesh again = filled(mesh, GetParam()).mesh;
  EXPECT_EQ(once.positions, again.positions);
  EXPECT_EQ(once.face_vertices(), again.face_vertices());
}

TEST_P(EveryFill, RefusesAMeshThatIsNotFinite) {
  Mesh mesh = sphere_with_hole(30.0);
  mesh.positions[mesh.face(0)[0]].x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(filled(mesh, GetParam()), InputError);
}

TEST_P(EveryFill, HolesThatTouchBecomeOneManifold) {
  // The faces around two vertices whose rings have one vertex in common.
  const Mesh whole = icosphere(3);
  const Topology& topology = whole.topology();
  const Index middle = 200;
  const auto ring = topology.rings[middle];
  const auto are_near = [&](Index a, Index b) {
    return std::ranges::count_if(topology.rings[a], [&](Index v) {
             return std::ranges::binary_search(topology.rings[b], v);
           }) > 1;
  };
  const auto far = std::ranges::find_if(ring, [&](Index v) { return !are_near(v, ring[0]); });
  ASSERT_NE(far, ring.end());
  KeepMask keep(whole.face_count(), 1);
  for (const Index center : {ring[0], *far}) {
    for (const Index t : topology.vertex_triangles[center]) keep[t] = 0;
  }
  Mesh touching = whole;
  keep_faces(touching, keep);
  Mesh split = touching;
  fix(split);
  EXPECT_GT(split.vertex_count(), whole.vertex_count() - 2);
  for (const Mesh& mesh : {touching, split}) {
    ASSERT_THAT(find_holes(mesh), SizeIs(2));
    Mesh result = filled(mesh, GetParam()).mesh;
    fix(result);
    expect_closed_manifold(result);
  }
}

TEST_P(EveryFill, NamesTheHoleThatItCannotFill) {
  const Mesh mesh = three_winged_edge();
  const std::vector<Hole> holes = find_holes(mesh);
  try {
    fill_holes(mesh, holes, GetParam());
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("the hole with 5 rim vertices at vertex 0 cannot be filled: at vertex "));
  }
}

INSTANTIATE_TEST_SUITE_P(FillHoles, EveryFill,
                         ::testing::Values(FillShape::flat, FillShape::smooth));

class SphereCap : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(SphereCap, ComesBack) {
  const auto [degrees, tolerance] = GetParam();
  const Mesh mesh = sphere_with_hole(degrees);
  const FilledHoles result = filled(mesh, FillShape::smooth);
  EXPECT_GT(result.vertices, 10U);
  double farthest = 0.0;
  for (std::size_t v = mesh.vertex_count(); v < result.mesh.vertex_count(); ++v) {
    farthest = std::max(farthest, std::abs(result.mesh.positions[v].norm() - 1.0));
  }
  EXPECT_LT(farthest, tolerance);
}

INSTANTIATE_TEST_SUITE_P(FillHoles, SphereCap,
                         ::testing::Values(std::pair(20.0, 0.002), std::pair(30.0, 0.008),
                                           std::pair(60.0, 0.12)));

TEST(SmoothFill, HasTrianglesOfTheSizeOfTheRim) {
  const Mesh mesh = sphere_with_hole(40.0);
  const Mesh whole = icosphere(4);
  const Mesh result = filled(mesh, FillShape::smooth).mesh;
  const double removed = static_cast<double>(whole.vertex_count() - mesh.vertex_count());
  EXPECT_NEAR(static_cast<double>(result.vertex_count() - mesh.vertex_count()) / removed, 1.0, 0.3);
}

TEST(SmoothFill, CanBeCancelledEverywhere) {
  const Mesh mesh = sphere_with_hole(40.0);
  EXPECT_GT(test::cancel_everywhere([&](const Progress& progress) {
              fill_holes(mesh, find_holes(mesh), FillShape::smooth, progress);
            }),
            20U);
}

}  // namespace
}  // namespace lapwing
