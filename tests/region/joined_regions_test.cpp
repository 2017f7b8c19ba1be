// Regions of a mesh with seams: a vertex stands for all that are one with it.
#include "lapwing/region/joined_regions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"
#include "support/split_meshes.h"

namespace lapwing {
namespace {

using ::testing::StartsWith;

class JoinedRegion : public ::testing::Test {
 protected:
  Index follower_of(Index leader) const {
    const auto found = std::ranges::find_if(joined_.followers,
                                            [&](Index v) { return joined_.leaders[v] == leader; });
    return found == joined_.followers.end() ? kNoIndex : *found;
  }
  VertexSet chosen(RegionSpec spec) const { return resolve_leaders(spec, joined_); }

  // Rows 0 to 3 in one chart, 3 to 6 in the other: row 3 is vertices 21 to 27.
  const Mesh mesh_ = grid(6, 6);
  const JoinedSurface joined_ = joined_surface(test::halves(mesh_).mesh);
};

TEST_F(JoinedRegion, IsThatOfTheMeshWithoutSeamsInEveryForm) {
  const Index twin = follower_of(24);
  ASSERT_NE(twin, kNoIndex);
  const RegionSpec disk{GeodesicDisk{twin, 0.4}};
  const RegionSpec whole_disk{GeodesicDisk{Index{24}, 0.4}};
  EXPECT_EQ(chosen(disk), resolve(whole_disk, mesh_));
  EXPECT_EQ(chosen({AllVertices{}}), resolve({AllVertices{}}, mesh_));
  const RegionSpec box{Box{{0.1, 0.3, -1.0}, {0.7, 0.9, 1.0}}};
  EXPECT_EQ(chosen(box), resolve(box, mesh_));
  EXPECT_EQ(chosen({ListedVertices{{twin, 3}}}), VertexSet({3, 24}));
  EXPECT_EQ(chosen({UnionRegion{{disk, {ListedVertices{{0}}}}}}),
            resolve({UnionRegion{{whole_disk, {ListedVertices{{0}}}}}}, mesh_));
  EXPECT_EQ(chosen({DifferenceRegion{{{AllVertices{}}, {ListedVertices{{twin}}}}}}),
            resolve({DifferenceRegion{{{AllVertices{}}, {ListedVertices{{24}}}}}}, mesh_));
  const RegionSpec loop{LoopRegion{{8, 12, 40, 36}, 24}};
  EXPECT_EQ(chosen({LoopRegion{{8, 12, 40, 36}, twin}}), resolve(loop, mesh_));
  EXPECT_EQ(chosen({DiskInRegion{{disk}}}), resolve({DiskInRegion{{whole_disk}}}, mesh_));
}

TEST_F(JoinedRegion, NamesAVertexThatIsNotThere) {
  const RegionSpec none{ListedVertices{{1000}}, "roi"};
  EXPECT_THAT(error_message<InputError>([&] { chosen(none); }),
              StartsWith("roi/vertices/0: vertex 1000"));
}

TEST_F(JoinedRegion, GetsItsFollowersBack) {
  const VertexSet all = with_followers(VertexSet{3, 24}, joined_);
  EXPECT_EQ(all, VertexSet({3, 24, follower_of(24)}));
  EXPECT_EQ(with_followers(VertexSet{3}, joined_), VertexSet({3}));
}

TEST_F(JoinedRegion, LeavesABeltByFractionAsItIs) {
  EXPECT_EQ(led(BeltSpec{BoundaryAnchors{0.2}}, joined_), BeltSpec{BoundaryAnchors{0.2}});
}

}  // namespace
}  // namespace lapwing
