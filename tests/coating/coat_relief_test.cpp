#include <gtest/gtest.h>

#include "coating/coating_scenes.h"
#include "lapwing/coating/fairing.h"

namespace lapwing::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kReliefHeight = 0.006;
constexpr double kWaves = 6.0;
constexpr double kReliefDetail = 3.0 / kWaves;
constexpr Index kReliefCells = 100;

/// A surface over the unit square around (0.5, 0.5).
struct Shape {
  const char* name;
  Vector3d (*at)(double x, double y);
};

Vector3d on_cylinder(double x, double y) {
  constexpr double kRadius = 0.5;
  return {kRadius * std::sin(x / kRadius), y, kRadius * std::cos(x / kRadius)};
}
Vector3d on_sphere(double x, double y) {
  return {x, y, std::sqrt(1.0 - x * x - y * y)};
}
Vector3d on_saddle(double x, double y) {
  return {x, y, 0.6 * (x * x - y * y)};
}

// Twice as long one way: what is round on the source is not round here.
Vector3d on_stretched(double x, double y) {
  return {2.0 * x, y, 0.0};
}

constexpr std::array<Shape, 4> kShapes{{{"cylinder", on_cylinder},
                                        {"sphere", on_sphere},
                                        {"saddle", on_saddle},
                                        {"stretched", on_stretched}}};

Mesh make(const Shape& shape, Index cells) {
  Mesh mesh = grid(cells, cells);
  for (Vector3d& p : mesh.positions) p = shape.at(p.x() - 0.5, p.y() - 0.5);
  return mesh;
}

/// Straight lines through what came out over what should have.
struct Match {
  double correlation = 0.0;
  double amplitude = 0.0;
};

Match match(const std::vector<double>& ideal, const std::vector<double>& measured) {
  const Eigen::Map<const Eigen::ArrayXd> x(ideal.data(), Eigen::Index(ideal.size()));
  const Eigen::Map<const Eigen::ArrayXd> y(measured.data(), Eigen::Index(measured.size()));
  const Eigen::ArrayXd dx = x - x.mean();
  const Eigen::ArrayXd dy = y - y.mean();
  const double product = (dx * dy).sum();
  return {product / std::sqrt(dx.square().sum() * dy.square().sum()), product / dx.square().sum()};
}

Correspondence corner_to_corner(const Coating& source, Index source_cells,
                                const PatchedMesh& target, Index target_cells) {
  CorrespondenceOptions map;
  map.domain = Domain::square;
  for (std::size_t c = 0; c < 4; ++c) {
    map.boundary_pairs.push_back({corners(source_cells)[c], corners(target_cells)[c]});
  }
  return correspond({source.patch, source.smooth}, target.placed(), map, "coat");
}

// A relief of known height carried to a shape: heights along its normals against the ideal, away
// from the border.
Match carry(const Shape& shape, Index cells, const CoatOptions& options) {
  const PatchedMesh source(relief(kReliefCells, kWaves, kReliefHeight));
  const PatchedMesh target(make(shape, cells));
  CpuKernels kernels;
  CoaterOptions coater_options;
  coater_options.hold_length = kReliefDetail;
  coater_options.transition.width = 0.08;
  const Coating coating = peel_cotangent(source, kReliefDetail);
  const auto map = corner_to_corner(coating, kReliefCells, target, cells);
  Coater coater({target.mesh.positions}, target.topology, target.patch, coater_options, kernels);
  coater.take(coating, map.points, options);
  const Positions coated = coater.coat(1.0);

  std::vector<Vector3d> normals(coated.size());
  vertex_normals(target.mesh.positions, target.topology.triangles, target.topology.vertex_triangles,
                 every_vertex(target.mesh), normals);
  std::vector<double> ideal;
  std::vector<double> measured;
  for (Index own = 0; own < target.patch.vertices.size(); ++own) {
    const Index v = target.patch.vertices[own];
    const Vector3d from = map.points[own].of<Vector3d>(coating.positions);
    if ((from.head<2>() - Vector2d(0.5, 0.5)).cwiseAbs().maxCoeff() > 0.35) continue;
    const double k = 2.0 * std::numbers::pi * kWaves;
    ideal.push_back(kReliefHeight * std::sin(k * from.x()) * std::sin(k * from.y()));
    measured.push_back((coated[v] - target.mesh.positions[v]).dot(normals[v]));
  }
  return match(ideal, measured);
}

struct Relief : testing::TestWithParam<std::tuple<Shape, Index, MappedSampling>> {};

TEST_P(Relief, KeepsItsShapeAndHeight) {
  const auto& [shape, cells, sampling] = GetParam();
  const Match result = carry(shape, cells, {sampling, 1.0});
  EXPECT_GT(result.correlation, 0.98);
  EXPECT_NEAR(result.amplitude, 1.0, 0.05);
  RecordProperty("correlation", std::to_string(result.correlation));
  RecordProperty("amplitude", std::to_string(result.amplitude));
}

std::string name_of_relief(const testing::TestParamInfo<Relief::ParamType>& test) {
  const auto& [shape, cells, sampling] = test.param;
  return std::string(shape.name) + "_" + std::to_string(cells) +
         (sampling == MappedSampling::one_ring ? "_one_ring" : "_linear");
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Relief,
    testing::Combine(testing::ValuesIn(kShapes), testing::Values(70U, 100U, 150U),
                     testing::Values(MappedSampling::one_ring, MappedSampling::linear)),
    name_of_relief);

TEST(Coat, IsAsHighInPlaceOfOtherDetailOnTrianglesTwiceAsFine) {
  constexpr Index kCells = 60;
  const PatchedMesh source(relief(kCells, 4.0, 0.01));
  const PatchedMesh target(uneven_relief(2 * kCells, 17.0, 0.003, 5));
  const Coating coating = peel_cotangent(source, 0.75);
  const Positions smooth =
      smooth_around(target.patch.vertices, 0.75, target.mesh.positions, target.topology,
                    LaplacianWeights::cotangent, "smooth_target");
  const auto map = corner_to_corner(coating, kCells, target, 2 * kCells);
  CpuKernels kernels;
  CoaterOptions options;
  options.hold_length = 0.75;
  options.transition.width = 0.1;
  Coater coater({target.mesh.positions, smooth}, target.topology, target.patch, options, kernels);
  for (const auto sampling : {MappedSampling::one_ring, MappedSampling::linear}) {
    coater.take(coating, map.points, {sampling, 1.0});
    const Positions coated = coater.coat(1.0);
    std::vector<double> ideal;
    std::vector<double> measured;
    for (Index own = 0; own < target.patch.vertices.size(); ++own) {
      const Vector3d from = map.points[own].of<Vector3d>(coating.positions);
      if ((from.head<2>() - Vector2d(0.5, 0.5)).cwiseAbs().maxCoeff() > 0.35) continue;
      ideal.push_back(from.z());
      measured.push_back(coated[target.patch.vertices[own]].z());
    }
    const Match result = match(ideal, measured);
    EXPECT_GT(result.correlation, 0.99);
    EXPECT_NEAR(result.amplitude, 1.0, 0.05);
  }
}

TEST(Coat, GrowsWithTheSurfaceItComesToUnlessToldNotTo) {
  // The same plane, three times as large.
  const PatchedMesh source(relief(60, 4.0, 0.01));
  const PatchedMesh target(transformed(grid(60, 60), Eigen::Affine3d(Eigen::Scaling(3.0))));
  const Coating coating = peel_cotangent(source, 0.75);
  const auto map = corner_to_corner(coating, 60, target, 60);
  CpuKernels kernels;
  CoaterOptions options;
  options.hold_length = 3.0 * 0.75;
  Coater coater({target.mesh.positions}, target.topology, target.patch, options, kernels);
  for (const auto sampling : {MappedSampling::one_ring, MappedSampling::linear}) {
    for (const auto& [scale, expected] :
         {std::pair<std::optional<double>, double>{std::nullopt, 3.0}, {0.5, 0.5}}) {
      coater.take(coating, map.points, {sampling, scale});
      const Positions coated = coater.coat(1.0);
      double highest = 0.0;
      for (const Vector3d& p : coated) highest = std::max(highest, p.z());
      EXPECT_NEAR(highest, expected * 0.01, 0.06 * expected * 0.01);
    }
  }
}

// From the foot of a mushroom up its stem, out below its cap, over the rim and to the top: distance
// from the axis and height.
constexpr std::array<std::array<double, 2>, 9> kProfile{{{0.25, 0.0},
                                                         {0.12, 0.0},
                                                         {0.08, 0.02},
                                                         {0.06, 0.05},
                                                         {0.07, 0.07},
                                                         {0.11, 0.08},
                                                         {0.11, 0.10},
                                                         {0.07, 0.13},
                                                         {0.0, 0.14}}};

// The point of the profile after `share` of its length.
Vector2d on_profile(double share) {
  const auto point = [](std::size_t i) { return Vector2d(kProfile[i][0], kProfile[i][1]); };
  double length = 0.0;
  for (std::size_t i = 1; i < kProfile.size(); ++i) length += (point(i) - point(i - 1)).norm();
  double left = share * length;
  for (std::size_t i = 1; i < kProfile.size(); ++i) {
    const double step = (point(i) - point(i - 1)).norm();
    if (left <= step) return point(i - 1) + left / step * (point(i) - point(i - 1));
    left -= step;
  }
  return point(kProfile.size() - 1);
}

// A stem with a cap wider than itself in the middle of the unit square: around the rim the surface
// lies three times above a point, so no height can say where it is.
Mesh mushroom(Index cells) {
  Mesh mesh = grid(cells, cells);
  for (Vector3d& p : mesh.positions) {
    const Vector2d around = p.head<2>() - Vector2d(0.5, 0.5);
    const double r = around.norm();
    if (r >= kProfile[0][0]) continue;
    const Vector2d point = on_profile(1.0 - r / kProfile[0][0]);
    const Vector2d direction = r > 0.0 ? Vector2d(around / r) : Vector2d::Zero();
    p << Vector2d(0.5, 0.5) + point.x() * direction, point.y();
  }
  return mesh;
}

// The area of the triangles that look against `up`, given per vertex.
double overhanging_area(const Topology& topology, const Positions& positions,
                        const std::vector<Vector3d>& up) {
  double area = 0.0;
  for (const auto& [a, b, c] : topology.triangles) {
    const Vector3d normal = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
    if (normal.dot(up[a]) < 0.0) area += 0.5 * normal.norm();
  }
  return area;
}

TEST(Coat, CarriesWhatNoHeightFieldCanExpress) {
  constexpr Index kCells = 80;
  const PatchedMesh source(mushroom(kCells));
  const PatchedMesh target(make(kShapes[1], kCells));
  const Coating coating = peel_cotangent(source, 2.0);
  const auto map = corner_to_corner(coating, kCells, target, kCells);
  CpuKernels kernels;
  CoaterOptions options;
  options.hold_length = 2.0;
  Coater coater({target.mesh.positions}, target.topology, target.patch, options, kernels);
  coater.take(coating, map.points, {MappedSampling::one_ring, 1.0});
  const Positions coated = coater.coat(1.0);

  const std::vector<Vector3d> up(source.mesh.vertex_count(), Vector3d::UnitZ());
  std::vector<Vector3d> normals(coated.size());
  vertex_normals(target.mesh.positions, target.topology.triangles, target.topology.vertex_triangles,
                 every_vertex(target.mesh), normals);
  const double on_source = overhanging_area(source.topology, source.mesh.positions, up);
  ASSERT_GT(on_source, 0.01);
  const double carried = overhanging_area(target.topology, coated, normals);
  EXPECT_GT(carried, 0.75 * on_source);
  EXPECT_LT(carried, 1.1 * on_source);
}

}  // namespace
}  // namespace lapwing::test
