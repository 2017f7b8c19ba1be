// Targets on real meshes: the linear system beside an independent solution, and single points that
// are pulled far.
#include <algorithm>
#include <random>

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include "lapwing/deform/deform.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/laplacian/weights.h"
#include "support/models.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

struct Named {
  std::string name;
  Mesh mesh;
};

// The first `count` closed triangle meshes of one piece of the package, in the order of their
// names, from every `stride`-th on, with 500 to 4,000 vertices.
std::vector<Named> closed_meshes(const std::vector<std::filesystem::path>& files,
                                 std::size_t count) {
  std::vector<Named> found;
  for (const auto& path : files) {
    if (found.size() == count) break;
    try {
      Mesh mesh = read_mesh(path);
      const Topology& topology = mesh.topology();
      const std::size_t n = mesh.vertex_count();
      const std::size_t edges = topology.rings.values.size() / 2;
      const bool is_closed = 3 * topology.triangles.size() == 2 * edges;
      if (n < 500 || n > 4000 || !is_closed) continue;
      if (connected_components(topology.rings).count != 1) continue;
      found.push_back({path.filename().string(), std::move(mesh)});
    } catch (const Error&) {
      // Broken on purpose.
    }
  }
  return found;
}

// The lowest tenth along the longest axis.
VertexSet foot(const Mesh& mesh, Eigen::Index& axis) {
  const Bounds bounds = bounds_of(mesh.positions);
  (bounds.max - bounds.min).maxCoeff(&axis);
  const double limit = bounds.min[axis] + 0.1 * (bounds.max - bounds.min)[axis];
  VertexSet belt;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions[v][axis] <= limit) belt.push_back(v);
  }
  return belt;
}

// Equation 5 with rows w_k (sum_c shares u_c - d_k), solved by Eigen.
Positions independent(const Mesh& mesh, const EditRegion& region) {
  const Topology& topology = mesh.topology();
  const auto weights = laplacian_weights(topology, mesh.positions, LaplacianWeights::cotangent);
  CpuKernels kernels;
  const BlockRows M =
      assemble_rsi_rows(kernels, {mesh.positions, topology.rings, weights, region.roi});
  std::vector<Eigen::Triplet<double>> entries;
  int rows = 0;
  for (std::size_t r = 0; r < M.size(); ++r, rows += 3) {
    for (std::size_t b = M.starts[r]; b < M.starts[r + 1]; ++b) {
      for (int k = 0; k < 9; ++k) {
        entries.emplace_back(rows + k % 3, static_cast<int>(3 * M.columns[b]) + k / 3,
                             M.values[9 * b + static_cast<std::size_t>(k)]);
      }
    }
  }
  std::vector<double> wanted(static_cast<std::size_t>(rows), 0.0);
  for (const Index v : region.belt) {
    for (int axis = 0; axis < 3; ++axis) {
      entries.emplace_back(rows++, static_cast<int>(3 * v) + axis, 1.0);
      wanted.push_back(0.0);
    }
  }
  for (const Target& target : region.targets) {
    const Vector3d d = target.position - point_of(target, mesh.positions);
    for (int axis = 0; axis < 3; ++axis, ++rows) {
      for (std::size_t c = 0; c < 3; ++c) {
        entries.emplace_back(rows, static_cast<int>(3 * target.corners[c]) + axis,
                             target.weight * target.shares[c]);
      }
      wanted.push_back(target.weight * d[axis]);
    }
  }
  Eigen::SparseMatrix<double> S(rows, static_cast<int>(3 * mesh.vertex_count()));
  S.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(S.transpose() * S);
  const Eigen::Map<const Eigen::VectorXd> b(wanted.data(), rows);
  Eigen::VectorXd u = factor.solve(S.transpose() * b);
  for (int k = 0; k < 3; ++k) u += factor.solve(S.transpose() * (b - S * u));
  Positions displacement;
  for (Index v = 0; v < mesh.vertex_count(); ++v) displacement.push_back(u.segment<3>(3 * v));
  return displacement;
}

TEST(TargetsOnModels, SolveTheLinearSystemAsEigenDoes) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  const std::vector<Named> meshes = closed_meshes(files, 5);
  ASSERT_EQ(meshes.size(), 5U);
  std::mt19937 random(7);
  for (const auto& [name, mesh] : meshes) {
    const double diagonal = bounds_of(mesh.positions).diagonal();
    Eigen::Index axis = 0;
    const VertexSet belt = foot(mesh, axis);
    std::normal_distribution<double> offset(0.0, 0.02 * diagonal);
    std::uniform_int_distribution<Index> any(0, static_cast<Index>(mesh.vertex_count()) - 1);
    DeformRequest request;
    request.roi = {AllVertices{}, "roi"};
    request.belt = RegionSpec{ListedVertices{belt}};
    request.parameters.response = LinearResponse::rsi;
    request.parameters.settle.reset();
    request.parameters.constraint_weight = 1.0;
    VertexSet chosen;
    for (int k = 0; k < 40; ++k) {
      const Index v = any(random);
      if (std::binary_search(belt.begin(), belt.end(), v)) continue;
      if (std::count(chosen.begin(), chosen.end(), v) > 0) continue;
      chosen.push_back(v);
      const Vector3d d(offset(random), offset(random), offset(random));
      const Triangle& t = mesh.topology().triangles[mesh.topology().vertex_triangles[v][0]];
      const bool touches_belt = std::any_of(t.begin(), t.end(), [&](Index c) {
        return std::binary_search(belt.begin(), belt.end(), c);
      });
      if (k % 2 == 0 || touches_belt) {
        request.targets.rows.push_back({v, mesh.positions[v] + d, 1.0 + k % 3});
      } else {
        const Vector3d middle =
            (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
        request.targets.rows.push_back({middle, middle + d, 1.0 + k % 3});
      }
    }
    Deformed deformed = deform(mesh, request);
    const Positions u = independent(mesh, deformed.region);
    double largest = 0.0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vector3d moved = deformed.mesh.positions[v] - mesh.positions[v];
      largest = std::max(largest, (moved - u[v]).norm());
    }
    EXPECT_LT(largest, 1e-9 * diagonal) << name;
  }
}

// The energy of the surface around keeps a single point from drawing a spike: how far an edge gets
// longer does not depend on how fine the mesh is there.
TEST(TargetsOnModels, PullOneVertexByAFifthOfTheDiagonalWithoutASpike) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  const std::vector<Named> meshes = closed_meshes(files, 10);
  ASSERT_EQ(meshes.size(), 10U);
  for (const auto& [name, mesh] : meshes) {
    const double diagonal = bounds_of(mesh.positions).diagonal();
    Eigen::Index axis = 0;
    DeformRequest request;
    request.roi = {AllVertices{}, "roi"};
    request.belt = RegionSpec{ListedVertices{foot(mesh, axis)}};
    Index top = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.positions[v][axis] > mesh.positions[top][axis]) top = v;
    }
    Vector3d way = Vector3d::Zero();
    way[axis] = 1.0;
    way[(axis + 1) % 3] = 1.0;
    const Vector3d there = mesh.positions[top] + 0.2 * diagonal * way.normalized();
    request.targets = {.rows = {{top, there}}, .hard = true};
    const Deformed deformed = deform(mesh, request);
    EXPECT_EQ(deformed.mesh.positions[top], there) << name;
    // One sliver of anchor.off, a hundredth as high as long, far from the vertex.
    const std::size_t expected = name == "anchor.off" ? 1 : 0;
    EXPECT_EQ(deformed.certificate.flipped_triangles, expected) << name;
    EXPECT_LT(deformed.certificate.largest_edge_stretch, 2.0) << name;
    RecordProperty(name, std::to_string(deformed.certificate.largest_edge_stretch));
  }
}

}  // namespace
}  // namespace lapwing
