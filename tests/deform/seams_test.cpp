// Tests that a mesh with duplicate vertices along seams deforms like the mesh without them.
#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform.h"
#include "lapwing/deform/modifiers/joined_request.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"
#include "support/bent_tube.h"
#include "support/error_message.h"
#include "support/joined_meshes.h"
#include "support/split_meshes.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The order of the vertices changes the rounding of a settled edit by less than this.
constexpr double kRounding = 1e-8;

// The first vertex that is a copy of `source`, or the last.
Index first_copy(const test::SplitMesh& split, Index source) {
  return static_cast<Index>(std::ranges::find(split.sources, source) - split.sources.begin());
}
Index last_copy(const test::SplitMesh& split, Index source) {
  const auto found = std::find(split.sources.rbegin(), split.sources.rend(), source);
  return static_cast<Index>(split.sources.rend() - found - 1);
}

// The largest distance of a copy from where its source is in the mesh that was not split.
double distance_from(const Positions& whole, const test::SplitMesh& split,
                     const Positions& positions) {
  double largest = 0.0;
  for (Index v = 0; v < split.sources.size(); ++v) {
    largest = std::max(largest, (positions[v] - whole[split.sources[v]]).norm());
  }
  return largest;
}

// Whether all copies are at one place.
bool is_closed(const test::SplitMesh& split, const Positions& positions) {
  std::vector<Index> firsts(split.sources.size(), kNoIndex);
  for (Index v = 0; v < split.sources.size(); ++v) {
    Index& first = firsts[split.sources[v]];
    if (first == kNoIndex) first = v;
    if (positions[v] != positions[first]) return false;
  }
  return true;
}

class ASeam : public ::testing::Test {
 protected:
  // A disk around a vertex is raised and turned by a smaller one.
  DeformRequest raise(Index center) const {
    SimilarityMove move;
    move.translate = {0.2, 0.1, 0.3};
    move.rotate = {Vector3d::UnitZ(), 20.0};
    DeformRequest request;
    request.roi = {GeodesicDisk{center, 0.9}, "roi"};
    request.handles = {{{GeodesicDisk{center, 0.3}, "handle"}, move}};
    return request;
  }
  // The head of the tube moves, its foot stays.
  DeformRequest bend(const test::SplitMesh& split) const {
    DeformRequest request;
    request.roi = {AllVertices{}, "roi"};
    request.belt = RegionSpec{Box{{-9, -9, -9}, {9, 9, mesh_.positions[23].z()}}, "belt"};
    VertexSet head;
    const EditRegion ends = test::foot_and_head(mesh_);
    for (const Index v : ends.handles[0]) head.push_back(last_copy(split, v));
    request.handles = {
        {{ListedVertices{head}, "head"},
         SimilarityMove{.translate = {0.4, 0.0, -0.2}, .rotate = {Vector3d::UnitY(), 40.0}}}};
    return request;
  }

  static constexpr Index kCenter = 125;
  const Mesh mesh_ = test::bumpy_tube();
  const test::SplitMesh whole_{mesh_, [this] {
                                 std::vector<Index> numbers;
                                 for (Index v = 0; v < mesh_.vertex_count(); ++v) {
                                   numbers.push_back(v);
                                 }
                                 return numbers;
                               }()};
  const std::array<test::SplitMesh, 2> splits_{test::halves(mesh_), test::soup(mesh_)};
};

TEST_F(ASeam, IsNotSeenByADiskAndItsHandle) {
  const Positions whole = deform(mesh_, raise(kCenter)).mesh.positions;
  for (const test::SplitMesh& split : splits_) {
    for (const Index center : {first_copy(split, kCenter), last_copy(split, kCenter)}) {
      const Deformed deformed = deform(split.mesh, raise(center));
      EXPECT_LT(distance_from(whole, split, deformed.mesh.positions), kRounding);
      EXPECT_TRUE(is_closed(split, deformed.mesh.positions));
      EXPECT_TRUE(deformed.mesh.shares_faces_with(split.mesh));
    }
  }
}

TEST_F(ASeam, InNumbersOfItsOwnChangesNoBitOfTheRest) {
  const test::SplitMesh& split = splits_[0];
  const Positions whole = deform(mesh_, raise(kCenter)).mesh.positions;
  const Positions positions = deform(split.mesh, raise(kCenter)).mesh.positions;
  EXPECT_EQ(distance_from(whole, split, positions), 0.0);
}

TEST_F(ASeam, IsNotSeenByAnyFormOfRegion) {
  const Deformed whole = deform(mesh_, bend(whole_));
  for (const test::SplitMesh& split : splits_) {
    const Deformed deformed = deform(split.mesh, bend(split));
    EXPECT_LT(distance_from(whole.mesh.positions, split, deformed.mesh.positions), kRounding);
    EXPECT_TRUE(is_closed(split, deformed.mesh.positions));
    EXPECT_EQ(deformed.region.roi.size(), split.mesh.vertex_count());
    EXPECT_EQ(deformed.region.free_count() + deformed.region.belt.size() +
                  deformed.region.handles[0].size(),
              split.mesh.vertex_count());
  }
  const auto by_loop = [&](const test::SplitMesh& split) {
    DeformRequest request = bend(split);
    LoopRegion loop{{}, last_copy(split, 239)};
    for (const Index v : {96, 100, 104}) loop.loop.push_back(last_copy(split, v));
    request.roi = {UnionRegion{{{loop}, {ListedVertices{{last_copy(split, 3)}}}}}, "roi"};
    const VertexSet border{last_copy(split, 100), last_copy(split, 3)};
    request.handles[0].region = {
        DifferenceRegion{{request.handles[0].region, {ListedVertices{{first_copy(split, 239)}}}}},
        "handle"};
    request.belt = RegionSpec{
        UnionRegion{{{ListedVertices{border}}, {Box{{-9, -9, -9}, {9, 9, 1.4}}}}}, "belt"};
    auto& belt = std::get<RegionSpec>(request.belt);
    belt = {DifferenceRegion{{belt, {Box{{-9, -9, -9}, {9, 9, 1.2}}}}}, "belt"};
    return deform(split.mesh, request);
  };
  const Deformed looped = by_loop(whole_);
  EXPECT_LT(looped.region.roi.size(), 150U);
  for (const test::SplitMesh& split : splits_) {
    EXPECT_LT(distance_from(looped.mesh.positions, split, by_loop(split).mesh.positions),
              kRounding);
  }
}

TEST_F(ASeam, IsNotSeenByTargets) {
  const auto pull = [&](const test::SplitMesh& split, bool hard) {
    DeformRequest request = bend(split);
    request.handles.clear();
    const Vector3d middle = (mesh_.positions[mesh_.topology().triangles[250][0]] +
                             mesh_.positions[mesh_.topology().triangles[250][1]] +
                             mesh_.positions[mesh_.topology().triangles[250][2]]) /
                            3.0;
    request.targets = {.rows = {{last_copy(split, 200), mesh_.positions[200] + Vector3d(0.3, 0, 0)},
                                {middle, middle + Vector3d(0.0, 0.2, 0.1), 3.0}},
                       .hard = hard};
    return deform(split.mesh, request);
  };
  for (const bool hard : {false, true}) {
    const Deformed whole = pull(whole_, hard);
    for (const test::SplitMesh& split : splits_) {
      const Deformed deformed = pull(split, hard);
      EXPECT_LT(distance_from(whole.mesh.positions, split, deformed.mesh.positions), kRounding);
      EXPECT_TRUE(is_closed(split, deformed.mesh.positions));
    }
  }
}

TEST_F(ASeam, GivesOneVertexOnePlace) {
  const test::SplitMesh& soup = splits_[1];
  DeformRequest request = bend(soup);
  const Vector3d there = mesh_.positions[130] + Vector3d(0.1, 0, 0);
  request.targets.rows = {{first_copy(soup, 130), there}, {last_copy(soup, 130), there}};
  EXPECT_EQ(deform(soup.mesh, request).region.targets.size(), 1U);
  request.targets.rows[1].position.x() += 0.1;
  EXPECT_THAT(error_message<InputError>([&] { deform(soup.mesh, request); }),
              HasSubstr("targets: row 1: vertex"));
  request.targets = {};
  request.handles.push_back(
      {{ListedVertices{{first_copy(soup, 239)}}, "another"}, SimilarityMove{}});
  EXPECT_THAT(error_message<InputError>([&] { deform(soup.mesh, request); }),
              HasSubstr("another: the handle shares vertex"));
}

TEST_F(ASeam, BelongsToTheRegionsWithAllItsVertices) {
  const test::SplitMesh& split = splits_[0];
  const EditRegion whole = deform(mesh_, raise(kCenter)).region;
  const Deformed deformed = deform(split.mesh, raise(kCenter));
  const auto all_of = [&](const VertexSet& set) {
    const std::vector<char> inside = vertex_mask(mesh_.vertex_count(), set);
    VertexSet all;
    for (Index v = 0; v < split.sources.size(); ++v) {
      if (inside[split.sources[v]]) all.push_back(v);
    }
    return all;
  };
  EXPECT_EQ(deformed.region.roi, all_of(whole.roi));
  EXPECT_EQ(deformed.region.belt, all_of(whole.belt));
  EXPECT_EQ(deformed.region.handles[0], all_of(whole.handles[0]));
}

TEST_F(ASeam, IsSaidWhereItLiesInTheRegionAlone) {
  const test::SplitMesh& split = splits_[0];
  DeformRequest request = raise(kCenter);
  EXPECT_THAT(deform(split.mesh, request).notes,
              Contains(HasSubstr("seam edges of the ROI are joined")));
  request.roi = {GeodesicDisk{200U, 0.5}};
  request.handles[0].region = {ListedVertices{{200}}};
  EXPECT_THAT(deform(split.mesh, request).notes, IsEmpty());
}

TEST_F(ASeam, OpensWhereItIsToBeLeft) {
  const test::SplitMesh& split = splits_[0];
  DeformRequest request = raise(kCenter);
  request.parameters.seams = SeamPolicy::leave;
  const Deformed left = deform(split.mesh, request);
  EXPECT_FALSE(is_closed(split, left.mesh.positions));
  EXPECT_THAT(left.notes, Not(Contains(HasSubstr("seam"))));
}

TEST_F(ASeam, ThatIsNotThereCostsNoBit) {
  DeformRequest request = raise(kCenter);
  const Positions joined = deform(mesh_, request).mesh.positions;
  request.parameters.seams = SeamPolicy::leave;
  EXPECT_EQ(deform(mesh_, request).mesh.positions, joined);
}

TEST_F(ASeam, StaysClosedInPartsAndFromOneRequestToTheNext) {
  CpuKernels kernels;
  for (const test::SplitMesh& split : splits_) {
    DeformRequest there = bend(split);
    there.parameters.commit_every = 15.0;
    DeformRequest on = raise(last_copy(split, kCenter));
    DeformWorkspace workspace;
    const Deformed once = deform(split.mesh, there, kernels, workspace);
    EXPECT_EQ(once.commits, 3U);
    const Mesh twice = deform(once.mesh, on, kernels, workspace).mesh;
    EXPECT_TRUE(is_closed(split, twice.positions));
    EXPECT_EQ(twice.positions, deform(once.mesh, on).mesh.positions);
    on.parameters.seams = SeamPolicy::leave;
    EXPECT_EQ(deform(once.mesh, on, kernels, workspace).mesh.positions,
              deform(once.mesh, on).mesh.positions);
    Mesh opened = once.mesh;
    opened.positions[last_copy(split, 140)].x() += 0.1;
    on.parameters.seams = SeamPolicy::join;
    EXPECT_EQ(deform(opened, on, kernels, workspace).mesh.positions,
              deform(opened, on).mesh.positions);
  }
}

TEST_F(ASeam, IsNotSeenByAMirror) {
  const auto mirrored = [&](const test::SplitMesh& split) {
    DeformRequest request = bend(split);
    request.handles[0].region = {ListedVertices{{last_copy(split, 231)}}, "head"};
    request.mirror = MirrorSpec{MirrorPlane{}};
    return deform(split.mesh, request);
  };
  const Deformed whole = mirrored(whole_);
  EXPECT_EQ(whole.region.handles.size(), 2U);
  for (const test::SplitMesh& split : splits_) {
    const Deformed deformed = mirrored(split);
    EXPECT_LT(distance_from(whole.mesh.positions, split, deformed.mesh.positions), kRounding);
  }
}

TEST_F(ASeam, OfThreeSheetsHoldsAllOfThem) {
  // Three square walls touch along the line x = y = 0. Each has separate vertices.
  Mesh walls;
  for (int k = 0; k < 3; ++k) {
    Mesh wall = grid(8, 8);
    const Eigen::AngleAxisd turn(2.1 * k, Vector3d::UnitZ());
    for (Vector3d& p : wall.positions) p = turn * Vector3d(p.x(), 0.0, p.y());
    walls = test::joined(std::move(walls), wall);
  }
  DeformRequest request;
  request.roi = {AllVertices{}};
  request.belt = RegionSpec{Box{{-2, -2, -1}, {2, 2, 0.01}}};
  request.handles = {{{Box{{-0.01, -0.01, 0.99}, {0.01, 0.01, 1.01}}},
                      SimilarityMove{.translate = {0.2, 0.1, 0.1}}}};
  const Deformed deformed = deform(walls, request);
  EXPECT_EQ(deformed.region.handles[0].size(), 3U);
  const Positions& p = deformed.mesh.positions;
  for (Index row = 0; row <= 8; ++row) {
    EXPECT_EQ(p[9 * row], p[81 + 9 * row]);
    EXPECT_EQ(p[9 * row], p[162 + 9 * row]);
  }
  EXPECT_GT((p[36] - walls.positions[36]).norm(), 0.02);
  EXPECT_TRUE(deformed.region.loose.empty());
}

TEST_F(ASeam, IsNoDuplicateVertex) {
  // A second tube that touches the first in one point stays where it is.
  Mesh other = mesh_;
  const Vector3d step = mesh_.positions[150] - mesh_.positions[155];
  for (Vector3d& p : other.positions) p += step;
  other.positions[155] = mesh_.positions[150];
  const Mesh both = test::joined(mesh_, other);
  DeformRequest request = raise(150);
  const Positions positions = deform(both, request).mesh.positions;
  const auto n = static_cast<std::ptrdiff_t>(mesh_.vertex_count());
  EXPECT_TRUE(std::equal(other.positions.begin(), other.positions.end(), positions.begin() + n));
  const Positions alone = deform(mesh_, request).mesh.positions;
  EXPECT_TRUE(std::equal(alone.begin(), alone.end(), positions.begin()));
}

// The needle 3 4 5 between two triangles that meet along it is no triangle of the joined surface.
TEST(GiveBackSeams, NamesFlippedTrianglesByTheirNumbersInTheMesh) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0},
                    {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (Index v = 0; v < 9; v += 3) mesh.add_face(std::array<Index, 3>{v, v + 1, v + 2});
  const JoinedSurface joined = joined_surface(mesh);
  Deformed result;
  result.mesh = joined.surface;
  result.certificate.first_flipped_triangles = {0, 1};
  give_back_seams(joined, mesh, "roi", result);
  EXPECT_THAT(result.certificate.first_flipped_triangles, ElementsAre(0, 2));
  EXPECT_EQ(result.mesh.positions, mesh.positions);
}

}  // namespace
}  // namespace lapwing
