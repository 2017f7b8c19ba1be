#include <algorithm>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/transplant/cut.h"
#include "support/models.h"
#include "transplant/loop_scenes.h"

// A part cut from a mesh and put back where it was.
namespace lapwing {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

// All within `rings` edges of `center`.
VertexSet around(const Mesh& mesh, Index center, int rings) {
  const Topology& topology = mesh.topology();
  VertexSet region{center};
  for (int k = 0; k < rings; ++k) region = with_ring_neighbours(region, topology.rings);
  return region;
}

// The triangles from the smallest corner on, in numbers of the original.
std::set<Triangle> triangles_of(const Mesh& mesh, std::span<const Index> numbers) {
  std::set<Triangle> triangles;
  for (Triangle triangle : mesh.topology().triangles) {
    for (Index& v : triangle) v = numbers[v];
    std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
    triangles.insert(triangle);
  }
  return triangles;
}

std::vector<BoundaryLoop> piece_loops(const Mesh& mesh) {
  return boundary_loops(mesh.topology().triangles, "piece");
}

void expect_exact_return(const Mesh& mesh, const VertexSet& region) {
  const CutPiece part = cut_out(mesh, region, "part");
  const CutPiece host = cut_away(mesh, region, "host");
  const Topology& part_topology = part.mesh.topology();
  const Topology& host_topology = host.mesh.topology();
  const auto part_loops = piece_loops(part.mesh);
  const auto host_loops = piece_loops(host.mesh);
  ASSERT_THAT(part_loops, SizeIs(1));
  ASSERT_THAT(host_loops, SizeIs(1));
  const Bridge bridge =
      bridge_loops(bridge_loop(host_topology.triangles, host.mesh.positions, host_loops[0]),
                   bridge_loop(part_topology.triangles, part.mesh.positions, part_loops[0]), "zip");
  EXPECT_THAT(bridge.welded, SizeIs(host_loops[0].size()));
  EXPECT_THAT(bridge.triangles, IsEmpty());

  const Joined joined = join(host.mesh, host_loops[0], part.mesh, part_loops[0], bridge, "");
  std::vector<Index> numbers(joined.mesh.vertex_count());
  std::ranges::copy(host.vertices, numbers.begin());
  for (std::size_t v = 0; v < part.vertices.size(); ++v) {
    numbers[joined.part_vertices[v]] = part.vertices[v];
  }
  for (std::size_t v = 0; v < numbers.size(); ++v) {
    ASSERT_EQ(joined.mesh.positions[v], mesh.positions[numbers[v]]);
  }
  std::vector<Index> own(mesh.vertex_count());
  std::iota(own.begin(), own.end(), Index{0});
  EXPECT_EQ(triangles_of(joined.mesh, numbers), triangles_of(mesh, own));
  EXPECT_EQ(joined.mesh.vertex_count(), mesh.vertex_count());
}

TEST(PutBack, ACapOfASphereIsTheSphereAgain) {
  const Mesh mesh = icosphere(4);
  for (const int rings : {1, 2, 5, 12, 20}) expect_exact_return(mesh, around(mesh, 99, rings));
}

// Without some of the triangles at its boundary, as long as that stays one loop.
Mesh nibbled(Mesh mesh, std::mt19937& random, int bites) {
  for (int bite = 0; bite < bites; ++bite) {
    const BoundaryLoop loop = piece_loops(mesh).at(0);
    const Topology& topology = mesh.topology();
    const auto around = topology.vertex_triangles[loop[random() % loop.size()]];
    KeepMask keep(mesh.face_count(), 1);
    keep[around[random() % around.size()]] = 0;
    Mesh smaller = mesh;
    keep_faces(smaller, keep);
    KeepMask used(mesh.vertex_count(), 0);
    for (const Index v : smaller.face_vertices()) used[v] = 1;
    keep_vertices(smaller, used);
    const CheckReport report = check(smaller);
    const bool whole = report.statistics.component_sizes.size() == 1;
    const bool one_loop = report.statistics.boundary_loops == 1;
    if (whole && one_loop && !report.find(DefectKind::bow_tie_vertex)) mesh = std::move(smaller);
  }
  return mesh;
}

// Rims with ears, chords and gaps, welded wherever they still meet.
TEST(PutBack, APartThatFitsInPlacesStillGivesAManifold) {
  const Mesh mesh = icosphere(3);
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    const VertexSet region = around(mesh, static_cast<Index>(random() % mesh.vertex_count()),
                                    1 + static_cast<int>(random() % 4));
    const Mesh part = nibbled(cut_out(mesh, region, "part").mesh, random, 8);
    const Mesh host = nibbled(cut_away(mesh, region, "host").mesh, random, 8);
    Mesh moved = part;
    const BoundaryLoop loop = piece_loops(part).at(0);
    for (unsigned k = 0; k < seed % 4; ++k) {
      moved.positions[loop[random() % loop.size()]] *= 1.0 + 0.05 * static_cast<double>(k);
    }
    const BoundaryLoop hole = piece_loops(host).at(0);
    const Bridge bridge =
        bridge_loops(bridge_loop(host.topology().triangles, host.positions, hole),
                     bridge_loop(moved.topology().triangles, moved.positions, loop), "zip");
    const Joined joined = join(host, hole, moved, loop, bridge, "");
    ASSERT_EQ(test::manifold_faults(joined.mesh), "") << seed;
    const CheckReport report = check(joined.mesh);
    ASSERT_EQ(report.statistics.boundary_edges, 0U) << seed;
    ASSERT_EQ(report.statistics.euler_characteristic, 2) << seed;
  }
}

TEST(PutBack, ABumpOfAModelIsTheModelAgain) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  for (const auto& file : files) {
    if (file.stem() != "elephant" && file.stem() != "ellipsoid" && file.stem() != "bull") continue;
    SCOPED_TRACE(file);
    const Mesh mesh = read_mesh(file);
    int tried = 0;
    for (Index center = 0; center < mesh.vertex_count() && tried < 3; center += 50) {
      const VertexSet region = around(mesh, center, 4);
      if (piece_loops(cut_out(mesh, region, "part").mesh).size() != 1) continue;
      expect_exact_return(mesh, region);
      ++tried;
    }
    EXPECT_EQ(tried, 3);
  }
}

}  // namespace
}  // namespace lapwing
