// Mirrored edits of real meshes: scans, whose plane is found, and halves made whole.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

#include "lapwing/deform/deform.h"
#include "lapwing/deform/modifiers/mirrored_request.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/run/run_recipe.h"
#include "support/models.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

Mesh model(const std::string& name) {
  return read_mesh(test::models_folder() / "cgal" / "meshes" / name);
}

struct Scan {
  const char* name;
  Vector3d normal;           // by eye
  double degrees;            // by which the plane that is found may be off from that
  double percent_asymmetry;  // at most
};

const Scan kScans[] = {
    {"armadillo.off", Vector3d::UnitX(), 5, 1.1},
    {"bear.off", Vector3d::UnitX(), 1, 1.5},
    {"camel.off", Vector3d::UnitX(), 1, 0.03},
    {"cow.off", Vector3d::UnitZ(), 1, 0.12},
    {"dino.off", Vector3d::UnitX(), 1, 0.15},
    {"dragknob.off", Vector3d::UnitY(), 1, 0.006},
    {"head.off", Vector3d::UnitZ(), 1, 0.02},
    {"helmet.off", Vector3d::UnitY(), 5, 0.4},
    {"homer.off", Vector3d::UnitX(), 1, 0.08},
    {"mannequin-devil.off", Vector3d::UnitX(), 1, 0.5},
    {"nefertiti.off", Vector3d::UnitX(), 2, 0.8},
    {"pig.off", Vector3d::UnitX(), 1, 0.2},
    {"triceratops.off", Vector3d::UnitZ(), 1, 1e-05},
};

TEST(MirrorOnModels, FindsThePlaneThatAPersonWouldName) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  for (const Scan& scan : kScans) {
    const FoundMirror found = find_mirror_plane(model(scan.name), "mirror");
    const double cosine = std::abs(found.plane.normal.normalized().dot(scan.normal.normalized()));
    EXPECT_LT(std::acos(std::min(1.0, cosine)) * 180.0 / std::numbers::pi, scan.degrees)
        << scan.name;
    EXPECT_LT(100.0 * found.asymmetry, scan.percent_asymmetry) << scan.name;
  }
}

// Compares each vertex v with the point q of the surface that is nearest to its mirror image.
class Symmetry {
 public:
  Symmetry(const Mesh& mesh, const MirrorPlane& plane) : mesh_(mesh), mirror_(reflection(plane)) {
    Adjacency all;
    for (Index t = 0; t < mesh.topology().triangles.size(); ++t) all.values.push_back(t);
    all.starts.push_back(static_cast<Index>(all.values.size()));
    surface_.emplace(mesh.topology().triangles, mesh.positions, all);
  }

  // The root mean square over `set` of the distance from v's image to q.
  double asymmetry(const VertexSet& set) const {
    return mean(set, [&](Index v, const TrianglePoint& q) {
      return (mirror_ * mesh_.positions[v] - q.position).squaredNorm();
    });
  }
  // The same of the difference between the mirror image of how v moved and how q moved.
  double difference_of_moves(const VertexSet& set, const Positions& pose) const {
    const auto move = [&](Index v) { return Vector3d(pose[v] - mesh_.positions[v]); };
    return mean(set, [&](Index v, const TrianglePoint& q) {
      Vector3d moved = Vector3d::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        moved += q.weights[k] * move(mesh_.topology().triangles[q.triangle][k]);
      }
      return (mirror_.linear() * move(v) - moved).squaredNorm();
    });
  }

 private:
  double mean(const VertexSet& set, const auto& of) const {
    double sum = 0.0;
    for (const Index v : set) sum += of(v, surface_->find(0, mirror_ * mesh_.positions[v]));
    return std::sqrt(sum / static_cast<double>(set.size()));
  }

  const Mesh& mesh_;
  Eigen::Affine3d mirror_;
  std::optional<ClosestPoint> surface_;
};

// What sticks out farthest from the plane, a hand, an ear or a foot, goes outward by a twentieth of
// the diagonal, along the plane by a tenth, and turns. Over the ROI, by how much pairs move
// differently is compared with how far the scan is from symmetric there: at most half of it.
TEST(MirrorOnModels, MovesPairsAlikeWithinTheAsymmetryOfTheScan) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  for (const char* name : {"armadillo.off", "bear.off", "mannequin-devil.off", "dino.off"}) {
    const Mesh mesh = model(name);
    const double diagonal = bounds_of(mesh.positions).diagonal();
    const FoundMirror found = find_mirror_plane(mesh, "mirror");
    const Vector3d n = found.plane.normal.normalized();
    Index out = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (n.dot(mesh.positions[v] - mesh.positions[out]) > 0.0) out = v;
    }
    SimilarityMove move;
    move.translate = 0.05 * diagonal * (n + 2.0 * n.unitOrthogonal());
    move.rotate = {n.unitOrthogonal(), 20.0};
    DeformRequest request;
    request.roi = {GeodesicDisk{out, 0.3 * diagonal}};
    request.handles = {{{GeodesicDisk{out, 0.08 * diagonal}}, move}};
    request.mirror = MirrorSpec{AutomaticMirror{}};
    const Deformed deformed = deform(mesh, request);
    ASSERT_EQ(deformed.region.handles.size(), 2U) << name;
    EXPECT_TRUE(deformed.certificate.settled) << name;
    const Symmetry symmetry(mesh, found.plane);
    const double asymmetry = symmetry.asymmetry(deformed.region.roi);
    const double difference =
        symmetry.difference_of_moves(deformed.region.roi, deformed.mesh.positions);
    EXPECT_LT(difference, 0.5 * asymmetry) << name;
    RecordProperty(name, std::to_string(difference / asymmetry));
  }
}

// The triangles of `mesh` on one side of a plane through its middle, and their mirror images. The
// cut's border is drawn into the plane, where both are welded.
Mesh made_symmetric(const Mesh& mesh, int axis) {
  const double middle = bounds_of(mesh.positions).center()[axis];
  const std::vector<Triangle>& triangles = mesh.topology().triangles;
  const auto is_inside = [&](Index v) { return mesh.positions[v][axis] > middle; };
  const auto inside = [&](const Triangle& t) { return std::all_of(t.begin(), t.end(), is_inside); };
  std::vector<char> is_cut(mesh.vertex_count(), 0);
  for (const Triangle& t : triangles) {
    for (const Index v : t) is_cut[v] |= static_cast<char>(!inside(t));
  }
  Mesh whole;
  std::map<Index, std::array<Index, 2>> numbers;
  const auto number = [&](Index v, std::size_t side) {
    const auto [found, is_new] = numbers.try_emplace(v);
    if (is_new) {
      Vector3d p = mesh.positions[v];
      p[axis] = is_cut[v] ? 0.0 : p[axis] - middle;
      found->second[0] = found->second[1] = static_cast<Index>(whole.positions.size());
      whole.positions.push_back(p);
      if (!is_cut[v]) {
        p[axis] = -p[axis];
        found->second[1] = static_cast<Index>(whole.positions.size());
        whole.positions.push_back(p);
      }
    }
    return found->second[side];
  };
  for (const Triangle& t : triangles) {
    const bool flat = std::all_of(t.begin(), t.end(), [&](Index v) { return is_cut[v] != 0; });
    if (!inside(t) || flat) continue;
    whole.add_face(std::array{number(t[0], 0), number(t[1], 0), number(t[2], 0)});
    whole.add_face(std::array{number(t[0], 1), number(t[2], 1), number(t[1], 1)});
  }
  return whole;
}

TEST(MirrorOnModels, AreSymmetricToRoundingWhereTheMeshIs) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  for (const auto& [name, axis] : {std::pair("homer.off", 0), std::pair("cow.off", 2),
                                   std::pair("lion-head.off", 0), std::pair("armadillo.off", 0)}) {
    const Mesh mesh = made_symmetric(model(name), axis);
    const Bounds bounds = bounds_of(mesh.positions);
    const MirrorPlane plane{Vector3d::Zero(), Vector3d::Unit(axis)};
    DeformRequest request;
    request.roi = {AllVertices{}};
    // The lowest quarter along the longest other axis stays; the farthest vertex above is moved.
    Eigen::Index up = (axis + 1) % 3;
    const Vector3d size = bounds.max - bounds.min;
    if (size[(axis + 2) % 3] > size[up]) up = (axis + 2) % 3;
    VertexSet low;
    Index top = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.positions[v][up] < bounds.min[up] + 0.25 * size[up]) low.push_back(v);
      const auto height = [&](Index w) {
        return mesh.positions[w][up] + 2.0 * mesh.positions[w].dot(plane.normal);
      };
      if (height(v) > height(top)) top = v;
    }
    request.belt = RegionSpec{ListedVertices{low}};
    SimilarityMove move;
    move.translate = 0.1 * bounds.diagonal() * Vector3d(1, -1, 1).normalized();
    request.handles = {{{GeodesicDisk{top, 0.05 * bounds.diagonal()}}, move}};
    request.handles[0].falloff.transition = Transition{0.1 * bounds.diagonal()};
    request.mirror = MirrorSpec{plane};
    const auto images = mirror_images(mesh, plane, "mirror");
    const Eigen::Affine3d mirror = reflection(plane);
    for (const bool settle : {false, true}) {
      request.parameters.settle.reset();
      if (settle) request.parameters.settle.emplace();
      const Positions positions = deform(mesh, request).mesh.positions;
      double largest = 0.0;
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.topology().rings.size(v) == 0) continue;
        largest = std::max(largest, (mirror * positions[v] - positions[images[v]]).norm());
      }
      // Settling ends a ten-thousandth of an edge before the least energy.
      EXPECT_LT(largest, (settle ? 1e-7 : 1e-9) * bounds.diagonal())
          << name << (settle ? " settled" : " linear");
    }
  }
}

TEST(MirrorOnModels, RaisesBothArms) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  Recipe recipe = read_recipe(std::filesystem::path(LAPWING_RECIPES_DIR) / "raise-arms.json");
  recipe.mesh = test::models_folder() / "cgal" / "meshes" / "armadillo.off";
  CpuKernels kernels;
  const auto result = run_recipe(recipe, kernels);
  const StepReport& step = result->report.steps.at(0);
  EXPECT_EQ(step.handles.size(), 2U);
  EXPECT_TRUE(step.deform->certificate.settled);
  EXPECT_EQ(step.deform->certificate.flipped_triangles, 0U);
  const std::vector<VertexSet>& hands = result->region.handles;
  for (const VertexSet& hand : hands) {
    double rise = 0.0;
    for (const Index v : hand) rise += (result->mesh.positions[v] - result->original[v]).y();
    EXPECT_NEAR(rise / static_cast<double>(hand.size()), 13.0, 1.0);
  }
}

}  // namespace
}  // namespace lapwing
