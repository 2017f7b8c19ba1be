#include "lapwing/remesh/halfedges.h"

#include <set>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/remesh/original_patch.h"
#include "remesh/remesh_checks.h"

namespace lapwing::remeshing {
namespace {

Halfedges halfedges_of(const Mesh& mesh) {
  return cut_patch(mesh, test::every_vertex(mesh)).net;
}

struct Counts {
  int vertices = 0, halfedges = 0, border = 0, triangles = 0;
  bool operator==(const Counts&) const = default;
};

// Counts what is there, after checking that everything points back.
Counts count_consistent(const Halfedges& net) {
  Counts counts;
  for (Index h = 0; h < net.halfedge_count(); ++h) {
    if (!net.is_alive(h)) continue;
    ++counts.halfedges;
    counts.triangles += h % 3 == 0;
    const Index twin = net.twin(h);
    EXPECT_NE(net.origin(h), net.target(h));
    if (twin == kNoIndex) {
      ++counts.border;
      EXPECT_EQ(net.outgoing(net.origin(h)), h) << "turning begins on the border";
      continue;
    }
    EXPECT_TRUE(net.is_alive(twin));
    EXPECT_EQ(net.twin(twin), h);
    EXPECT_EQ(net.origin(h), net.target(twin));
    EXPECT_EQ(net.target(h), net.origin(twin));
    if (net.on_line(h)) {
      EXPECT_EQ(net.side(twin), net.side(h) ^ 1U);
    }
  }
  int around = 0;
  for (Index v = 0; v < net.vertex_count(); ++v) {
    if (!net.has_vertex(v)) continue;
    ++counts.vertices;
    net.for_outgoing(v, [&](Index h) {
      EXPECT_EQ(net.origin(h), v);
      ++around;
    });
  }
  EXPECT_EQ(around, counts.halfedges) << "turning about all vertices meets every half-edge";
  return counts;
}

Index inner_edge(const Halfedges& net) {
  for (Index h = 0; h < net.halfedge_count(); ++h) {
    if (net.twin(h) == kNoIndex) continue;
    if (!net.is_border_vertex(net.origin(h)) && net.is_border_vertex(net.target(h))) return h;
  }
  return kNoIndex;
}

TEST(Halfedges, SplitAddsAVertexAndTwoTriangles) {
  Halfedges net = halfedges_of(grid(4, 4));
  const Counts before = count_consistent(net);
  const Index h = inner_edge(net);
  const Index end = net.target(h);
  const Index m = net.split(h);
  EXPECT_EQ(net.valence(m), 4);
  EXPECT_EQ(net.target(h), m);
  std::set<Index> ring;
  net.for_neighbours(m, [&](Index w) { ring.insert(w); });
  EXPECT_TRUE(ring.contains(end));
  EXPECT_EQ(count_consistent(net), (Counts{before.vertices + 1, before.halfedges + 6, before.border,
                                           before.triangles + 2}));
}

TEST(Halfedges, FlipKeepsAllCountsAndTwiceTurnsTheEdgeAround) {
  Halfedges net = halfedges_of(grid(4, 4));
  const Counts before = count_consistent(net);
  const Index h = inner_edge(net);
  const std::set<Index> ends{net.origin(h), net.target(h)};
  const std::set<Index> apexes{net.apex(h), net.apex(net.twin(h))};
  net.flip(h);
  EXPECT_EQ((std::set<Index>{net.origin(h), net.target(h)}), apexes);
  EXPECT_EQ(count_consistent(net), before);
  net.flip(h);
  EXPECT_EQ((std::set<Index>{net.origin(h), net.target(h)}), ends);
  EXPECT_EQ(count_consistent(net), before);
}

TEST(Halfedges, CollapseOntoTheBorderKeepsTheBorder) {
  Halfedges net = halfedges_of(grid(4, 4));
  const Counts before = count_consistent(net);
  const Index h = inner_edge(net);
  const Index gone = net.origin(h);
  net.collapse(h);
  EXPECT_FALSE(net.has_vertex(gone));
  EXPECT_EQ(count_consistent(net), (Counts{before.vertices - 1, before.halfedges - 6, before.border,
                                           before.triangles - 2}));
}

TEST(Halfedges, CollapseUndoesASplit) {
  Halfedges net = halfedges_of(icosphere(1));
  const Counts before = count_consistent(net);
  for (Index h = 0; h < net.halfedge_count(); h += 7) {
    if (!net.is_alive(h) || h > 1000) continue;
    net.split(h);
    net.collapse(net.twin(h));  // from the new vertex back to the origin
    ASSERT_EQ(count_consistent(net), before);
  }
}

TEST(Halfedges, LinesStayWhereTrianglesBesideThemVanish) {
  // A line around the middle of a sphere of 42 vertices; every other vertex on it goes.
  const Mesh mesh = icosphere(2);
  Halfedges net = halfedges_of(mesh);
  int on_line = 0;
  for (Index h = 0; h < net.halfedge_count(); ++h) {
    const double a = mesh.positions[net.origin(h)].z();
    const double b = mesh.positions[net.target(h)].z();
    if (std::abs(a) > 1e-9 || std::abs(b) > 1e-9 || net.on_line(h)) continue;
    net.set_side(h, 0);
    net.set_side(net.twin(h), 1);
    ++on_line;
  }
  ASSERT_GT(on_line, 6);
  for (Index h = 0; h < net.halfedge_count(); ++h) {
    const bool free = net.is_alive(h) && !net.on_line(h) && net.valence(net.origin(h)) == 6;
    int lines = 0;
    if (free) net.for_outgoing(net.origin(h), [&](Index out) { lines += net.on_line(out); });
    if (!free || lines != 0 || net.valence(net.apex(h)) < 5) continue;
    net.collapse(h);
    break;
  }
  count_consistent(net);
  int left = 0;
  for (Index h = 0; h < net.halfedge_count(); ++h) left += net.is_alive(h) && net.on_line(h);
  EXPECT_EQ(left, 2 * on_line);
}

}  // namespace
}  // namespace lapwing::remeshing
