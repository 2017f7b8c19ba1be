// Edits of real meshes with seams, slivers and loose components.
#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/mesh/topology.h"
#include "support/models.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::Contains;
using ::testing::HasSubstr;

struct NamedModel {
  std::string name;
  Mesh mesh;
};

// Those of both packages that can be read.
std::vector<NamedModel> meshes_of(const std::vector<std::filesystem::path>& cgal,
                                  const std::vector<std::filesystem::path>& assimp) {
  std::vector<std::filesystem::path> files = cgal;
  files.insert(files.end(), assimp.begin(), assimp.end());
  std::vector<NamedModel> meshes;
  for (const auto& path : files) {
    try {
      Mesh mesh = read_mesh(path);
      mesh.topology();
      meshes.push_back({path.filename().string(), std::move(mesh)});
    } catch (const Error&) {
      // Broken on purpose.
    }
  }
  return meshes;
}

// One end of the longest axis stays, the other moves aside and turns.
DeformRequest bend(const Mesh& mesh) {
  const Bounds bounds = bounds_of(mesh.positions);
  const double diagonal = bounds.diagonal();
  Eigen::Index axis = 0;
  const Vector3d size = bounds.max - bounds.min;
  size.maxCoeff(&axis);
  const auto end = [&](double from, double to) {
    const Vector3d margin = Vector3d::Constant(1e-6 * diagonal);
    Box box{bounds.min - margin, bounds.max + margin};
    box.min[axis] += from * size[axis];
    box.max[axis] -= (1.0 - to) * size[axis];
    return RegionSpec{box};
  };
  SimilarityMove move;
  move.translate[(axis + 1) % 3] = 0.15 * diagonal;
  move.rotate = {Vector3d::Unit((axis + 2) % 3), 15.0};
  DeformRequest request;
  request.roi = {AllVertices{}};
  request.belt = end(0.0, 0.15);
  request.handles = {{end(0.85, 1.0), move}};
  return request;
}

double largest_distance_at_seams(const JoinedSurface& joined, const Positions& positions) {
  double largest = 0.0;
  for (const Index v : joined.followers) {
    largest = std::max(largest, (positions[v] - positions[joined.leaders[v]]).norm());
  }
  return largest;
}

TEST(SeamsOfModels, StayClosedWhileOneEndIsBent) {
  LAPWING_NEEDS_MODELS(cgal, "cgal");
  LAPWING_NEEDS_MODELS(assimp, "assimp");
  std::size_t count = 0;
  for (const auto& [name, mesh] : meshes_of(cgal, assimp)) {
    const JoinedSurface joined = joined_surface(mesh);
    if (joined.empty()) continue;
    ++count;
    const Deformed deformed = deform(mesh, bend(mesh));
    EXPECT_EQ(largest_distance_at_seams(joined, deformed.mesh.positions), 0.0) << name;
    EXPECT_TRUE(deformed.certificate.settled) << name;
    EXPECT_LE(deformed.certificate.flipped_triangles, name == "boeing.off" ? 2U : 1U) << name;
    RecordProperty(name, std::to_string(joined.edges.size()));
  }
  EXPECT_GE(count, 10U);
}

// Wuson comes in two files whose vertices are split differently.
TEST(SeamsOfModels, TwoFilesOfOneSurfaceAreEditedAlike) {
  LAPWING_NEEDS_MODELS(cgal, "cgal");
  LAPWING_NEEDS_MODELS(assimp, "assimp");
  std::vector<Certificate> found;
  for (const auto& [name, mesh] : meshes_of(cgal, assimp)) {
    if (name != "Wuson.off" && name != "Wuson.ply") continue;
    found.push_back(deform(mesh, bend(mesh)).certificate);
  }
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].detail_error, found[1].detail_error, 1e-8);
  EXPECT_NEAR(found[0].edge_stretch, found[1].edge_stretch, 1e-8);
  EXPECT_NEAR(found[0].largest_rotation_degrees, found[1].largest_rotation_degrees, 1e-6);
}

struct Thinnest {
  Triangle corners{};
  double share = 1.0;  // its height over its longest side
};

Thinnest thinnest_of(const Mesh& mesh) {
  Thinnest thinnest;
  for (const Triangle& t : mesh.topology().triangles) {
    const Vector3d a = mesh.positions[t[1]] - mesh.positions[t[0]];
    const Vector3d b = mesh.positions[t[2]] - mesh.positions[t[0]];
    const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
    const double share = longest > 0.0 ? a.cross(b).norm() / longest : 1.0;
    if (share < thinnest.share) thinnest = {t, share};
  }
  return thinnest;
}

// A landmark at each corner of a mesh's thinnest triangle and one within it, each by itself.
TEST(SliversOfModels, CarryLandmarks) {
  LAPWING_NEEDS_MODELS(cgal, "cgal");
  LAPWING_NEEDS_MODELS(assimp, "assimp");
  constexpr double kThin = 1e-3;
  constexpr std::size_t kMostVertices = 6000;
  std::size_t count = 0;
  for (const auto& [name, mesh] : meshes_of(cgal, assimp)) {
    if (mesh.vertex_count() > kMostVertices || mesh.vertex_count() < 20) continue;
    const Thinnest thinnest = thinnest_of(mesh);
    if (thinnest.share > kThin) continue;
    const double diagonal = bounds_of(mesh.positions).diagonal();
    const Vector3d pull = 0.05 * diagonal * Vector3d(1, 2, -1).normalized();
    DeformRequest request;
    request.roi = {AllVertices{}};
    request.belt = bend(mesh).belt;
    // A belt that does not give way at all leaves up to 8 triangles flipped (regr01.obj).
    request.parameters.constraint_weight = 1.0;
    std::vector<TargetRow> rows;
    Vector3d within = Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& p = mesh.positions[thinnest.corners[k]];
      rows.push_back({thinnest.corners[k], p + pull});
      within += std::array{0.5, 0.2, 0.3}[k] * p;
    }
    rows.push_back({within, within + pull});
    ++count;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (const bool hard : {false, true}) {
        request.targets = {.rows = {rows[r]}, .hard = hard};
        const std::string where = name + ", row " + std::to_string(r) + (hard ? ", hard" : "");
        try {
          const Deformed deformed = deform(mesh, request);
          const Certificate& c = deformed.certificate;
          EXPECT_TRUE(c.settled) << where;
          // The most are at triangles without area, flips and stretch (regr01.obj).
          EXPECT_LE(c.flipped_triangles, name == "regr01.obj" ? 3U : 1U) << where;
          EXPECT_LT(c.largest_edge_stretch, 3.0) << where;
          EXPECT_TRUE(c.all_finite) << where;
          EXPECT_LT(c.target_error, hard ? 1e-6 * diagonal : pull.norm()) << where;
        } catch (const InputError& error) {
          // The triangle lies in the belt.
          EXPECT_NE(std::string(error.what()).find("belt"), std::string::npos)
              << where << ": " << error.what();
        }
      }
    }
    RecordProperty(name, std::to_string(thinnest.share));
  }
  EXPECT_GE(count, 10U);
}

// Every mesh of the packages with a tenth of its vertices held at each end of the longest axis.

// Three to hold, three to move, and some between.
constexpr std::size_t kLeastVertices = 6;

// The last tenth goes aside by a tenth of the diagonal.
DeformRequest move_one_end(const Mesh& mesh) {
  const Bounds bounds = bounds_of(mesh.positions);
  Eigen::Index axis = 0;
  (bounds.max - bounds.min).maxCoeff(&axis);
  std::vector<Index> order(mesh.vertex_count());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return mesh.positions[a][axis] < mesh.positions[b][axis];
  });
  const auto tenth = static_cast<std::ptrdiff_t>(std::max<std::size_t>(3, order.size() / 10));
  DeformRequest request;
  request.roi = {AllVertices{}, "roi"};
  request.belt =
      RegionSpec{ListedVertices{make_vertex_set({order.begin(), order.begin() + tenth})}, "belt"};
  request.handles = {
      {{ListedVertices{make_vertex_set({order.end() - tenth, order.end()})}, "handle"},
       SimilarityMove{.translate = 0.1 * bounds.diagonal() * Vector3d::Unit((axis + 1) % 3)}}};
  return request;
}

bool is_refused(const Mesh& mesh, DeformRequest request) {
  request.parameters.loose = LoosePolicy::refuse;
  try {
    resolve_edit_region(request, mesh);
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.find("anchor") != std::string::npos;
  }
  return false;
}

TEST(LooseOfModels, IsCarriedWithANoteWhereItWasRefused) {
  LAPWING_NEEDS_MODELS(cgal, "cgal");
  LAPWING_NEEDS_MODELS(assimp, "assimp");
  std::size_t refused = 0;
  for (const auto& [name, mesh] : meshes_of(cgal, assimp)) {
    if (mesh.vertex_count() < kLeastVertices) continue;
    const DeformRequest request = move_one_end(mesh);
    if (!is_refused(mesh, request)) continue;
    ++refused;
    try {
      const Deformed carried = deform(mesh, request);
      EXPECT_TRUE(carried.certificate.all_finite) << name;
      RecordProperty(name, carried.notes.empty() ? "" : carried.notes.front());
      EXPECT_THAT(carried.notes,
                  Contains(::testing::AnyOf(HasSubstr("loose component"), HasSubstr("seam edges"),
                                            HasSubstr("rotates as little"))))
          << name;
    } catch (const Error& error) {
      ADD_FAILURE() << name << ": " << error.what();
    }
  }
  EXPECT_GE(refused, 16U);
  RecordProperty("refused", static_cast<int>(refused));
}

}  // namespace
}  // namespace lapwing
