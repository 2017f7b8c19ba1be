#include "lapwing/parameterize/mean_value.h"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/region/largest_disk.h"
#include "parameterize/test_patches.h"
#include "support/error_message.h"
#include "support/models.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::hills;
using test::moved;
using test::placed;
using test::PlacedPatch;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::array kDomains{Domain::disk, Domain::square};

double largest_distance(std::span<const Vector2d> a, std::span<const Vector2d> b) {
  double largest = a.size() == b.size() ? 0.0 : 1e300;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    largest = std::max(largest, (a[k] - b[k]).norm());
  }
  return largest;
}

std::vector<Index> inner_vertices(const Patch& patch) {
  std::vector<Index> inner;
  for (Index v = 0; v < patch.size(); ++v) {
    if (std::find(patch.loop.begin(), patch.loop.end(), v) == patch.loop.end()) inner.push_back(v);
  }
  return inner;
}

// A flat grid whose inner vertices lie anywhere that keeps its triangles upright.
Mesh jittered_plane(unsigned seed) {
  Mesh mesh = grid(12, 9);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  for (Vector3d& p : mesh.positions) {
    if (p.x() > 0 && p.x() < 1) p.x() += shift(random) / 12;
    if (p.y() > 0 && p.y() < 1) p.y() += shift(random) / 9;
  }
  return mesh;
}

TEST(MeanValue, ReproducesAPlaneWhoseBoundaryIsHeld) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const PlacedPatch flat = placed(jittered_plane(seed));
    std::vector<Vector2d> boundary;
    for (const Index v : flat.patch.loop) boundary.push_back(flat.positions[v].head<2>());
    std::vector<Vector2d> own;
    for (const Vector3d& p : flat.positions) own.push_back(p.head<2>());
    EXPECT_LT(largest_distance(mean_value_points(flat.patch, flat.positions, boundary), own),
              1e-13);
  }
}

TEST(MeanValue, WeightsArePositiveAndSumToOne) {
  const PlacedPatch sheet = placed(hills());
  const BlockRows A =
      mean_value_rows(sheet.patch.triangles, sheet.positions, inner_vertices(sheet.patch));
  for (std::size_t row = 0; row < A.size(); ++row) {
    double sum = 0.0;
    for (std::size_t k = A.starts[row] + 1; k < A.starts[row + 1]; ++k) {
      EXPECT_LT(A.values[k], 0.0);
      sum += A.values[k];
    }
    EXPECT_EQ(A.values[A.starts[row]], 1.0);
    EXPECT_NEAR(sum, -1.0, 1e-14);
  }
}

// Floater's formula as it is printed, angles by arc cosine.
TEST(MeanValue, WeightsAreThoseOfTheFormula) {
  const PlacedPatch sheet = placed(hills());
  const Patch& patch = sheet.patch;
  const std::vector<Index> inner = inner_vertices(patch);
  const BlockRows A = mean_value_rows(patch.triangles, sheet.positions, inner);
  for (std::size_t row = 0; row < A.size(); row += 7) {
    const Vector3d center = sheet.positions[inner[row]];
    std::vector<double> weights(patch.size(), 0.0);
    double sum = 0.0;
    for (const Triangle& t : patch.triangles) {
      const auto at = std::find(t.begin(), t.end(), inner[row]) - t.begin();
      if (at == 3) continue;
      const Index j = t[static_cast<std::size_t>(at + 1) % 3];
      const Index k = t[static_cast<std::size_t>(at + 2) % 3];
      const Vector3d u = sheet.positions[j] - center;
      const Vector3d v = sheet.positions[k] - center;
      const double angle = std::acos(u.dot(v) / (u.norm() * v.norm()));
      weights[j] += std::tan(angle / 2) / u.norm();
      weights[k] += std::tan(angle / 2) / v.norm();
      sum += std::tan(angle / 2) * (1 / u.norm() + 1 / v.norm());
    }
    for (std::size_t k = A.starts[row] + 1; k < A.starts[row + 1]; ++k) {
      EXPECT_NEAR(-A.values[k], weights[A.columns[k]] / sum, 1e-12);
    }
  }
}

TEST(MeanValue, SolutionLeavesNoResidual) {
  const PlacedPatch sheet = placed(hills(40, 30));
  const BlockRows A =
      mean_value_rows(sheet.patch.triangles, sheet.positions, inner_vertices(sheet.patch));
  for (const Domain domain : kDomains)
    EXPECT_LT(largest_residual(A, sheet.map(domain).points), 1e-15);
}

TEST(MeanValue, BoundaryGoesRoundTheDomainByArcLength) {
  const PlacedPatch sheet = placed(hills());
  const std::vector<Index>& loop = sheet.patch.loop;
  const DomainMap disk = mean_value_map(sheet.patch, sheet.positions, Domain::disk, {loop[5]});
  EXPECT_LT((disk.points[loop[5]] - Vector2d(1, 0)).norm(), 1e-15);
  double ratio = 0.0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Index a = loop[(k + 5) % loop.size()];
    const Index b = loop[(k + 6) % loop.size()];
    EXPECT_NEAR(disk.points[a].norm(), 1.0, 1e-15);
    const double arc = std::atan2(
        disk.points[a].x() * disk.points[b].y() - disk.points[a].y() * disk.points[b].x(),
        disk.points[a].dot(disk.points[b]));
    const double scale = arc / (sheet.positions[b] - sheet.positions[a]).norm();
    if (k == 0) ratio = scale;
    EXPECT_NEAR(scale, ratio, 1e-12 * ratio);
  }
  const DomainMap square = mean_value_map(sheet.patch, sheet.positions, Domain::square,
                                          {loop[0], loop[3], loop[20], loop[50]});
  EXPECT_EQ(square.points[loop[0]], Vector2d(0, 0));
  EXPECT_EQ(square.points[loop[3]], Vector2d(1, 0));
  EXPECT_EQ(square.points[loop[20]], Vector2d(1, 1));
  EXPECT_EQ(square.points[loop[50]], Vector2d(0, 1));
  for (const Vector2d& p : square.points) {
    EXPECT_TRUE((p.array() >= 0.0).all() && (p.array() <= 1.0).all());
  }
}

TEST(MeanValue, MapIsThatOfTheMovedMesh) {
  for (const Domain domain : kDomains) {
    EXPECT_LT(largest_distance(placed(hills()).map(domain).points,
                               placed(moved(hills())).map(domain).points),
              1e-9);
  }
}

TEST(MeanValue, StripsEarsAndTrianglesLieFlatWithoutFolds) {
  Mesh triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 3}};
  triangle.add_face(std::array<Index, 3>{0, 1, 2});
  Mesh ear = grid(2, 2);
  ear.positions.emplace_back(-1, -1, 0);
  ear.add_face(std::array<Index, 3>{9, 1, 0});
  for (const Mesh& mesh : {grid(1, 1), grid(9, 1), ear, triangle}) {
    const PlacedPatch patch = placed(mesh);
    for (const Domain domain : kDomains) {
      if (patch.patch.loop.size() < 4 && domain == Domain::square) continue;
      const DomainMap map = patch.map(domain);
      EXPECT_THAT(flipped_triangles(patch.patch.triangles, map.points), IsEmpty());
    }
  }
}

TEST(MeanValue, HubOfManyTrianglesIsMapped) {
  Mesh wheel;
  constexpr Index kSpokes = 3000;
  wheel.positions.emplace_back(0, 0, 0.5);
  for (Index k = 0; k < kSpokes; ++k) {
    const double angle = 2.0 * 3.14159265358979 * k / kSpokes;
    for (const double radius : {0.5, 1.0}) {
      wheel.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
  }
  for (Index k = 0; k < kSpokes; ++k) {
    const Index inner = 1 + 2 * k;
    const Index next = 1 + 2 * ((k + 1) % kSpokes);
    wheel.add_face(std::array<Index, 3>{0, inner, next});
    wheel.add_face(std::array<Index, 3>{inner, inner + 1, next});
    wheel.add_face(std::array<Index, 3>{inner + 1, next + 1, next});
  }
  const PlacedPatch patch = placed(wheel);
  EXPECT_THAT(flipped_triangles(patch.patch.triangles, patch.map(Domain::disk).points), IsEmpty());
}

// Vertices fallen onto each other, triangles fallen flat, long needles.
TEST(MeanValue, TrianglesWithoutAreaGiveFinitePointsWithoutFolds) {
  Mesh mesh = grid(10, 10);
  const auto put = [&](Index v, Index onto) { mesh.positions[v] = mesh.positions[onto]; };
  put(24, 25);  // two inner vertices
  put(11, 0);   // two boundary vertices
  mesh.positions[60] = 0.5 * (mesh.positions[61] + mesh.positions[59]);
  mesh.positions[84] = mesh.positions[83] + Vector3d(1e-14, 0, 0);
  for (Index v = 35; v < 40; ++v) mesh.positions[v] = mesh.positions[35];
  for (const Domain domain : kDomains) {
    const PlacedPatch patch = placed(mesh);
    const DomainMap map = patch.map(domain);
    for (const Vector2d& p : map.points) EXPECT_TRUE(p.allFinite());
    EXPECT_THAT(flipped_triangles(patch.patch.triangles, map.points), IsEmpty());
  }
}

TEST(MeanValue, PatchWithoutAreaIsRefused) {
  Mesh line = grid(4, 4);
  for (Vector3d& p : line.positions) p = Vector3d(p.x() + p.y(), 2 * (p.x() + p.y()), 1.0);
  Mesh point = grid(4, 4);
  for (Vector3d& p : point.positions) p = Vector3d(1, 2, 3);
  for (const Mesh& mesh : {line, point}) {
    for (const Domain domain : kDomains) {
      EXPECT_THAT(error_message<InputError>([&] { placed(mesh).map(domain); }),
                  HasSubstr("the patch of 32 triangles around vertex 0 has zero area"));
    }
  }
}

TEST(MeanValue, PositionsThatAreNotFiniteAreRefused) {
  PlacedPatch patch = placed(grid(3, 3));
  patch.positions[6].x() = std::nan("");
  EXPECT_THAT(error_message<InputError>([&] { patch.map(Domain::disk); }),
              HasSubstr("vertex 6 of the patch has a non-finite position"));
}

TEST(FlippedTriangles, AreThoseTurnedOverOrFlattened) {
  const std::vector<Vector2d> points{{0, 0}, {1, 0}, {0, 1}, {2, 0}, {0.3, 0.1}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 1}, {0, 1, 3}, {0, 4, 2}};
  EXPECT_THAT(flipped_triangles(triangles, points), ElementsAre(1, 2));
  // A third of the way along an edge is on it only as far as rounding goes.
  const std::vector<Vector2d> nearly{{0, 0}, {0.9, 0.3}, {0.9 / 3, 0.3 / 3}};
  EXPECT_THAT(flipped_triangles(std::vector<Triangle>{{0, 1, 2}, {0, 2, 1}}, nearly),
              ElementsAre(0, 1));
}

// Disks around random vertices, up to a quarter of the mesh's extent in radius; where they are
// none, the largest disk inside. One that winds through narrow places shrinks the parts behind
// them, or lays them against a side of the square, below what coordinates can tell apart.
class ModelPatches : public ::testing::TestWithParam<const char*> {
 protected:
  static constexpr std::size_t kLargest = 12'000;

  static std::optional<PlacedPatch> random_patch(const Mesh& mesh, std::mt19937& random) {
    const Topology& topology = mesh.topology();
    const auto center = static_cast<Index>(random() % mesh.vertex_count());
    const double share = 0.03 + 0.22 * static_cast<double>(random() % 1000) / 1000.0;
    const double radius = share * bounds_of(mesh.positions).diagonal();
    if (!(radius > 0.0) || !mesh.positions[center].allFinite()) return {};
    VertexSet region = resolve({GeodesicDisk{center, radius}, "disk"}, mesh);
    region = largest_disk(region, topology, mesh.positions);
    if (region.size() < 4) return {};
    PlacedPatch result;
    result.patch = disk_patch(region, topology, mesh.positions, "disk");
    result.positions = on_patch(result.patch, std::span<const Vector3d>(mesh.positions));
    return result;
  }
};

constexpr double kRoundingOfCoordinates = 1e-15;

// The flipped triangles whose corner lies behind the longest edge by more than rounding.
std::vector<Index> plain_folds(std::span<const Triangle> triangles,
                               std::span<const Vector2d> points) {
  std::vector<Index> folds;
  for (const Index t : flipped_triangles(triangles, points)) {
    const auto& [a, b, c] = triangles[t];
    const Vector2d u = points[b] - points[a];
    const Vector2d v = points[c] - points[a];
    const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
    if (u.x() * v.y() - u.y() * v.x() < -kRoundingOfCoordinates * longest) folds.push_back(t);
  }
  return folds;
}

TEST_P(ModelPatches, AreMappedWithoutFolds) {
  LAPWING_NEEDS_MODELS(files, GetParam());
  std::mt19937 random(5);
  std::size_t mapped = 0;
  std::size_t folded = 0;
  for (const auto& file : files) {
    Mesh mesh;
    try {
      mesh = read_mesh(file);
    } catch (const Error&) {
      continue;  // some are broken on purpose
    }
    const Topology& topology = mesh.topology();
    if (topology.triangles.empty() || mesh.vertex_count() > kLargest) continue;
    for (int round = 0; round < 4; ++round) {
      const auto patch = random_patch(mesh, random);
      if (!patch) continue;
      for (const Domain domain : kDomains) {
        if (domain == Domain::square && patch->patch.loop.size() < 4) continue;
        const DomainMap map = patch->map(domain);
        EXPECT_THAT(plain_folds(patch->patch.triangles, map.points), IsEmpty())
            << file << " around vertex " << patch->patch.vertices.front() << " with "
            << patch->patch.size();
        folded += flipped_triangles(patch->patch.triangles, map.points).empty() ? 0U : 1U;
        ++mapped;
      }
    }
  }
  EXPECT_GT(mapped, files.size());
  EXPECT_LE(100 * folded, mapped);
}

INSTANTIATE_TEST_SUITE_P(Packages, ModelPatches, ::testing::Values("cgal", "assimp"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace lapwing
