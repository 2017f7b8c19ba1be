#include "lapwing/coating/correspondence.h"

#include <gtest/gtest.h>

#include "coating/coating_scenes.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;

std::string message_of(const PatchedMesh& source, const PatchedMesh& target,
                       const CorrespondenceOptions& options) {
  return error_message<InputError>(
      [&] { correspond(source.placed(), target.placed(), options, "steps/0"); });
}

CorrespondenceOptions inner(std::vector<VertexPair> pairs) {
  CorrespondenceOptions options;
  options.inner_pairs = std::move(pairs);
  return options;
}

TEST(Correspondence, OfAPatchWithItselfIsTheIdentity) {
  const PatchedMesh square(bumpy_plane(12, 2, 0.2));
  for (const Domain domain : {Domain::disk, Domain::square}) {
    CorrespondenceOptions options;
    options.domain = domain;
    const auto map = correspond(square.placed(), square.placed(), options, "coat");
    for (Index own = 0; own < square.patch.vertices.size(); ++own) {
      EXPECT_LT((map.points[own].of<Vector3d>(square.own) - square.own[own]).norm(), 1e-9);
    }
    EXPECT_EQ(map.flipped_source + map.flipped_target, 0U);
    EXPECT_EQ(map.pins.size(), domain == Domain::disk ? 1U : 4U);
  }
}

TEST(Correspondence, LaysBoundaryPairsOnEachOther) {
  const PatchedMesh source(grid(10, 10));
  const PatchedMesh target(grid(7, 7));
  CorrespondenceOptions options;
  options.domain = Domain::square;
  for (std::size_t c = 0; c < 4; ++c) {
    // A quarter turn.
    options.boundary_pairs.push_back({corners(10)[c], corners(7)[(c + 1) % 4]});
  }
  const auto map = correspond(source.placed(), target.placed(), options, "coat");
  for (Index own = 0; own < target.patch.vertices.size(); ++own) {
    const Vector3d p = target.own[own];
    const Vector3d turned(p.y(), 1.0 - p.x(), 0.0);
    EXPECT_LT((map.points[own].of<Vector3d>(source.own) - turned).norm(), 1e-9);
  }
  EXPECT_EQ(map.pins, options.boundary_pairs);
}

TEST(Correspondence, MeetsInnerPairsAndStaysBijective) {
  const PatchedMesh source(grid(20, 20));
  const PatchedMesh target(bumpy_plane(14, 2, 0.1));
  // (0.4, 0.4) of the source to about (0.6, 0.5) of the target, and the other way round elsewhere.
  CorrespondenceOptions options = inner({{8 * 21 + 8, 7 * 15 + 9}, {14 * 21 + 12, 9 * 15 + 6}});
  options.domain = Domain::square;
  for (std::size_t c = 0; c < 4; ++c) {
    options.boundary_pairs.push_back({corners(20)[c], corners(14)[c]});
  }
  const auto map = correspond(source.placed(), target.placed(), options, "coat");
  for (const auto& [s, t] : options.inner_pairs) {
    EXPECT_LT((map.points[t].of<Vector3d>(source.own) - source.own[s]).norm(), 1e-6);
  }
  EXPECT_EQ(map.flipped_source, 0U);
  EXPECT_GT(map.warp.steps, 0);
}

TEST(Correspondence, WithoutBoundaryPairsIsTurnedSoThatInnerPairsComeNear) {
  const PatchedMesh source(bumpy_plane(20, 2, 0.1));
  // Three inner vertices and where they are after half a turn of the grid.
  const auto turned = [](Index v) { return 21 * 21 - 1 - v; };
  CorrespondenceOptions options;
  for (const Index v : {5 * 21 + 4, 6 * 21 + 15, 15 * 21 + 8}) {
    options.inner_pairs.push_back({v, turned(v)});
  }
  for (const Domain domain : {Domain::disk, Domain::square}) {
    options.domain = domain;
    const auto map = correspond(source.placed(), source.placed(), options, "coat");
    for (const auto& [s, t] : options.inner_pairs) {
      EXPECT_LT((map.points[t].of<Vector3d>(source.own) - source.own[s]).norm(), 1e-6);
    }
    EXPECT_EQ(map.warp.constrained_steps, 0);
    EXPECT_EQ(map.flipped_source, 0U);
    // The pins that are told are where the borders meet.
    for (const auto& [s, t] : map.pins) {
      EXPECT_LT((map.source.points[s] - map.target.points[t]).norm(), 0.1);
    }
  }
}

TEST(Correspondence, NamesAPairThatIsOffItsPatch) {
  const PatchedMesh whole(grid(8, 8));
  const PatchedMesh part(grid(8, 8), within(grid(8, 8), Vector3d(0.5, 0.5, 0), 0.3));
  CorrespondenceOptions options;
  options.boundary_pairs = {{0, 0}};
  EXPECT_THAT(message_of(whole, part, options),
              testing::AllOf(testing::HasSubstr("steps/0/boundary_pairs/0: vertex 0 is not in the "
                                                "target patch"),
                             testing::HasSubstr("choose one of them")));
  EXPECT_THAT(message_of(part, whole, inner({{40, 40}, {0, 41}})),
              testing::HasSubstr("steps/0/inner_pairs/1: vertex 0 is not in the source patch"));
}

TEST(Correspondence, TellsBoundaryPairsFromInnerOnes) {
  const PatchedMesh square(grid(8, 8));
  CorrespondenceOptions options;
  options.boundary_pairs = {{10, 0}};
  EXPECT_THAT(
      message_of(square, square, options),
      testing::HasSubstr("vertex 10 lies inside the source patch, but a boundary pair needs "
                         "a vertex on its boundary; the nearest is 1"));
  EXPECT_THAT(message_of(square, square, inner({{40, 3}})),
              testing::HasSubstr("vertex 3 lies on the boundary of the target patch"));
}

TEST(Correspondence, CountsTheBoundaryPairs) {
  const PatchedMesh square(grid(8, 8));
  CorrespondenceOptions options;
  options.domain = Domain::square;
  options.boundary_pairs = {{0, 0}};
  EXPECT_THAT(
      message_of(square, square, options),
      testing::HasSubstr("the square needs four pairs in order around the boundary, got 1"));
}

TEST(Correspondence, NamesPairsThatContradictEachOther) {
  const PatchedMesh square(grid(12, 12));
  EXPECT_THAT(message_of(square, square, inner({{6 * 13 + 6, 80}, {6 * 13 + 6, 95}})),
              testing::HasSubstr("vertex 84 of the source is also in pair 0"));
  EXPECT_THAT(message_of(square, square, inner({{5 * 13 + 5, 84}, {7 * 13 + 7, 84}})),
              testing::AllOf(testing::HasSubstr("cannot all be satisfied"),
                             testing::HasSubstr("[70, 84]"), testing::HasSubstr("[98, 84]")));
}

}  // namespace
}  // namespace lapwing::test
