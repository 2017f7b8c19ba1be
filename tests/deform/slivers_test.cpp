// Landmarks on triangles without area, or next to none: the system stays regular, and the surface
// moves as it does without them.
#include <algorithm>
#include <array>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/deform/deform.h"
#include "lapwing/mesh/shapes.h"
#include "support/largest_distance.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using test::largest_distance;

constexpr Index kCells = 12;
constexpr std::array<Index, 2> kEdge{6 * (kCells + 1) + 6, 6 * (kCells + 1) + 7};

// A wavy sheet.
Mesh sheet() {
  Mesh mesh = grid(kCells, kCells);
  for (Vector3d& p : mesh.positions) p.z() = 0.05 * std::sin(9.0 * p.x()) * std::cos(7.0 * p.y());
  return mesh;
}

Vector3d normal_of(const Mesh& mesh, std::span<const Index> face) {
  const auto& p = mesh.positions;
  return (p[face[1]] - p[face[0]]).cross(p[face[2]] - p[face[0]]).normalized();
}

// The same with a triangle of `height` in an edge: its third corner, the last vertex, lies that far
// beside the middle of the edge, in the plane of a face there, which is cut in two.
Mesh with_sliver(double height) {
  const Mesh whole = sheet();
  Mesh mesh;
  mesh.positions = whole.positions;
  const auto middle = static_cast<Index>(whole.vertex_count());
  bool is_cut = false;
  for (std::size_t f = 0; f < whole.face_count(); ++f) {
    const auto face = whole.face(f);
    const auto start = std::ranges::find(face, kEdge[0]);
    const bool has_edge =
        start != face.end() && std::ranges::find(face, kEdge[1]) != face.end() && !is_cut;
    if (!has_edge) {
      mesh.add_face(face);
      continue;
    }
    is_cut = true;
    std::array<Index, 3> t{face[0], face[1], face[2]};
    while (t[2] == kEdge[0] || t[2] == kEdge[1]) std::rotate(t.begin(), t.begin() + 1, t.end());
    const Vector3d along = mesh.positions[t[1]] - mesh.positions[t[0]];
    const Vector3d inward = normal_of(whole, face).cross(along).normalized();
    mesh.positions.push_back(mesh.positions[t[0]] + 0.4 * along + height * inward);
    mesh.add_face(std::array{t[0], t[1], middle});
    mesh.add_face(std::array{t[1], t[2], middle});
    mesh.add_face(std::array{t[2], t[0], middle});
  }
  return mesh;
}

DeformRequest pinned() {
  DeformRequest request;
  request.roi = {AllVertices{}};
  request.belt =
      RegionSpec{DifferenceRegion{{{AllVertices{}}, {Box{{0.05, 0.05, -1}, {0.95, 0.95, 1}}}}}};
  return request;
}

const Vector3d kPull(0.05, -0.02, 0.2);

struct Sliver {
  double height;
  const char* name;
};

class ALandmark : public ::testing::TestWithParam<Sliver> {};

TEST_P(ALandmark, AtACornerOfASliverMovesTheSurfaceAsWithoutIt) {
  const Mesh mesh = with_sliver(GetParam().height);
  DeformRequest request = pinned();
  for (const LaplacianWeights weights : {LaplacianWeights::cotangent, LaplacianWeights::uniform}) {
    for (const bool hard : {false, true}) {
      request.parameters.weights = weights;
      request.targets.hard = hard;
      request.targets.rows = {{kEdge[0], mesh.positions[kEdge[0]] + kPull}};
      const Positions whole = deform(sheet(), request).mesh.positions;
      const Deformed deformed = deform(mesh, request);
      EXPECT_LT(largest_distance(whole, deformed.mesh.positions), 0.15 * kPull.norm());
      EXPECT_LT(largest_distance(mesh.positions, deformed.mesh.positions), 1.1 * kPull.norm());
      EXPECT_TRUE(deformed.certificate.settled);
    }
  }
}

TEST_P(ALandmark, AtTheTipOfASliverIsReached) {
  const Mesh mesh = with_sliver(GetParam().height);
  const auto tip = static_cast<Index>(mesh.vertex_count() - 1);
  DeformRequest request = pinned();
  for (const LaplacianWeights weights : {LaplacianWeights::cotangent, LaplacianWeights::uniform}) {
    request.parameters.weights = weights;
    request.targets = {.rows = {{tip, mesh.positions[tip] + kPull}}, .hard = true};
    const Deformed deformed = deform(mesh, request);
    EXPECT_EQ(deformed.mesh.positions[tip], mesh.positions[tip] + kPull);
    EXPECT_LT(largest_distance(mesh.positions, deformed.mesh.positions), 1.1 * kPull.norm());
    // The corners of the sliver come along.
    for (const Index v : kEdge) {
      EXPECT_LT((deformed.mesh.positions[v] - mesh.positions[v] - kPull).norm(),
                0.5 * kPull.norm());
    }
    EXPECT_TRUE(deformed.certificate.settled);
  }
}

TEST_P(ALandmark, WithinASliverIsReached) {
  const Mesh mesh = with_sliver(GetParam().height);
  const Vector3d place = 0.8 * mesh.positions[kEdge[0]] + 0.2 * mesh.positions[kEdge[1]];
  DeformRequest request = pinned();
  for (const bool hard : {false, true}) {
    request.targets = {.rows = {{place, place + kPull, 100.0}}, .hard = hard};
    const Deformed deformed = deform(mesh, request);
    EXPECT_LT(deformed.certificate.target_error, 0.01 * kPull.norm());
    EXPECT_LT(largest_distance(mesh.positions, deformed.mesh.positions), 1.5 * kPull.norm());
    EXPECT_TRUE(deformed.certificate.settled);
  }
}

// The paper's linear system as well, which is not positive by its energy.
TEST_P(ALandmark, OnASliverLeavesTheLinearSystemRegular) {
  const Mesh mesh = with_sliver(GetParam().height);
  const auto tip = static_cast<Index>(mesh.vertex_count() - 1);
  DeformRequest request = pinned();
  request.parameters.settle.reset();
  for (const LinearResponse response : {LinearResponse::tangent, LinearResponse::rsi}) {
    request.parameters.response = response;
    request.targets.rows = {{tip, mesh.positions[tip] + kPull},
                            {kEdge[0], mesh.positions[kEdge[0]] + kPull}};
    const Deformed deformed = deform(mesh, request);
    EXPECT_LT(deformed.certificate.relative_residual, 1e-9);
    EXPECT_LT(largest_distance(mesh.positions, deformed.mesh.positions), 2.0 * kPull.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(OfHeight, ALandmark,
                         ::testing::Values(Sliver{0.0, "None"}, Sliver{1e-15, "Rounding"},
                                           Sliver{1e-9, "OneBillionth"},
                                           Sliver{1e-4, "OneTenThousandth"}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace lapwing
