#include "lapwing/remesh/working_patch.h"

#include <functional>
#include <optional>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/remesh/feature_lines.h"
#include "lapwing/remesh/fold_check.h"
#include "remesh/remesh_checks.h"

namespace lapwing::remeshing {
namespace {

using Eigen::Vector3d;

// A patch of the mesh ready to be remeshed, with what it refers to.
struct Prepared {
  Prepared(const Mesh& mesh, const VertexSet& region) : original(cut_patch(mesh, region)) {
    const std::vector<double> lengths(original.positions.size(), 0.25);
    find_feature_lines(mesh, 45.0, lengths, original);
    patch.emplace(original, target, lengths);
  }

  // The own number of a mesh vertex; the last one where there are several.
  Index own(Index mesh_vertex) const {
    Index found = kNoIndex;
    for (Index v = 0; v < original.mesh_vertices.size(); ++v) {
      if (original.mesh_vertices[v] == mesh_vertex) found = v;
    }
    return found;
  }

  std::function<double(const Vector3d&)> length = test::everywhere(0.25);
  TargetSizingField target{length};
  OriginalPatch original;
  std::optional<WorkingPatch> patch;
};

TEST(WorkingPatch, KnowsVerticesThatOnlyAFaceOutsideJoins) {
  const Mesh plane = grid(4, 4);
  const VertexSet region = subtract(test::every_vertex(plane), {12});
  Mesh bridged = plane;
  bridged.add_face(std::array<Index, 3>{0, 24, 12});
  const Prepared apart(plane, region);
  EXPECT_FALSE(apart.patch->are_joined(apart.own(0), apart.own(24)));
  const Prepared joined(bridged, region);
  EXPECT_TRUE(joined.patch->are_joined(joined.own(0), joined.own(24)));
  EXPECT_TRUE(joined.patch->are_joined(joined.own(24), joined.own(0)));
}

TEST(WorkingPatch, TakesTheFansOfOneVertexAsOne) {
  const Mesh plane = grid(4, 4);
  // Two quarters that meet in vertex 12 only.
  const VertexSet region = test::vertices_where(plane, [](const Vector3d& p) {
    return (p.x() <= 0.5 && p.y() <= 0.5) || (p.x() >= 0.5 && p.y() >= 0.5);
  });
  const Prepared touching(plane, region);
  const Index one = touching.own(12);
  const Index other = touching.original.next_copy[one];
  ASSERT_NE(one, other);
  EXPECT_EQ(touching.original.next_copy[other], one);
  EXPECT_TRUE(touching.patch->is_same(one, other));
  for (const Index copy : {one, other}) {
    touching.patch->net.for_neighbours(copy, [&](Index neighbour) {
      EXPECT_TRUE(touching.patch->are_joined(one, neighbour));
      EXPECT_TRUE(touching.patch->are_joined(other, neighbour));
      EXPECT_TRUE(touching.patch->are_joined(neighbour, one));
    });
  }
}

TEST(WorkingPatch, ProjectsOntoTheSurfaceAndLineVerticesOntoTheirLine) {
  const Mesh box = bar(4, 4, 1.0, 1.0);
  Prepared prepared(box, test::every_vertex(box));
  int on_lines = 0;
  for (Index v = 0; v < prepared.original.positions.size(); ++v) {
    const Vector3d& p = prepared.original.positions[v];
    const Vector3d pushed = p + Vector3d(0.02, 0.03, 0.04);
    const Vector3d back = prepared.patch->project(v, pushed, prepared.patch->normal_at(v));
    if (prepared.original.kinds[v] == VertexKind::free) {
      EXPECT_LT((back - p).norm(), 0.06);
    } else if (prepared.original.kinds[v] == VertexKind::line) {
      EXPECT_EQ(((back - p).array().abs() > 1e-12).count(), 1) << "along one axis";
      ++on_lines;
    }
  }
  EXPECT_EQ(on_lines, 12 * 3);
}

TEST(FoldsWhenMoved, OnlyWhereAnEdgeBecomesSharp) {
  const Mesh plane = grid(4, 4);
  const Prepared flat(plane, test::every_vertex(plane));
  const Index middle = flat.own(12);
  const Vector3d& p = flat.patch->at(middle);
  EXPECT_FALSE(folds_when_moved(*flat.patch, p + Vector3d(0.05, 0.0, 0.02), middle));
  EXPECT_TRUE(folds_when_moved(*flat.patch, p + Vector3d(0.0, 0.0, 1.0), middle));
  EXPECT_TRUE(folds_when_moved(*flat.patch, p + Vector3d(0.4, 0.0, 0.0), middle)) << "over its rim";
}

TEST(FoldsWhenMoved, LooksAcrossTheTrianglesThatVanish) {
  const Mesh plane = grid(4, 4);
  const Prepared flat(plane, test::every_vertex(plane));
  const Index middle = flat.own(12);
  const Index beside = flat.own(13);
  const Vector3d& p = flat.patch->at(beside);
  EXPECT_FALSE(folds_when_moved(*flat.patch, p, middle, beside));
  EXPECT_TRUE(folds_when_moved(*flat.patch, p + Vector3d(0.0, 0.0, 1.0), middle, beside));
}

}  // namespace
}  // namespace lapwing::remeshing
