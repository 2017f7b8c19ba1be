// Based on: Botsch and Kobbelt, "A remeshing approach to multiresolution modeling", 2004; the
// sizing field as in Dunyach et al., "Adaptive remeshing for real-time mesh deformation", 2013.
#include "lapwing/remesh/isotropic.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/limits.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/remesh/feature_lines.h"
#include "lapwing/remesh/passes.h"
#include "lapwing/remesh/transfer_to_mesh.h"

namespace lapwing {
namespace {

using namespace remeshing;

// Memory per triangle during remeshing, including the search tree of the original patch and the
// transfer of attributes. Measured for 1.3 million triangles.
constexpr double kBytesPerTriangle = 400.0;
// Relaxation steps per iteration. A second step is more effective than additional iterations.
constexpr int kRelaxations = 2;

void require_options(const RemeshOptions& options) {
  if (options.iterations < 0) throw InputError("the remeshing iterations must be 0 or more");
  if (!std::isfinite(options.feature_angle_degrees)) {
    throw InputError("the feature angle for remeshing must be finite");
  }
}

void require_vertices(const Mesh& mesh, const VertexSet& region) {
  if (region.empty() || region.back() < mesh.vertex_count()) return;
  throw InputError("the region to remesh names vertex " + std::to_string(region.back()) +
                   ", but the mesh has " + std::to_string(mesh.vertex_count()) + " vertices");
}

double expected_faces(const OriginalPatch& patch, const std::vector<double>& lengths) {
  double faces = 0.0;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    const auto& [i, j, k] = patch.triangles[t];
    const auto [a, b, c] = patch.corner_positions(t);
    const double wanted = (lengths[i] + lengths[j] + lengths[k]) / 3.0;
    faces += expected_triangles(a, b, c, wanted);
  }
  return faces;
}

void require_reasonable(double faces) {
  require_at_most(kMostTriangles, faces, "remeshing to this edge length would make about",
                  "choose a greater length or a smaller region");
  require_memory(static_cast<std::size_t>(kBytesPerTriangle * faces),
                 "remeshing to this edge length", "choose a greater length or a smaller region");
}

std::vector<double> lengths_at(const Positions& positions, const TargetSizingField& target) {
  std::vector<double> lengths;
  lengths.reserve(positions.size());
  for (const Eigen::Vector3d& p : positions) lengths.push_back(target.at(p));
  return lengths;
}

RemeshResult unchanged(const Mesh& mesh) {
  RemeshResult result;
  result.mesh = mesh;
  result.kept.resize(mesh.vertex_count());
  std::iota(result.kept.begin(), result.kept.end(), Index{0});
  result.note = "no face has all its corners in the region, so nothing was remeshed";
  return result;
}

}  // namespace

double expected_triangles(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c, double length) {
  const double sides = (b - a).norm() + (c - b).norm() + (a - c).norm();
  if (length == 0.0) return sides == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
  return (b - a).cross(c - a).norm() * (2.0 / std::sqrt(3.0)) / (length * length) + sides / length;
}

RemeshResult remesh_isotropic(const Mesh& mesh, const VertexSet& region,
                              const std::function<double(const Eigen::Vector3d&)>& target_length,
                              const RemeshOptions& options, const Progress& progress) {
  const ProgressScope scope(progress);
  validate_indices(mesh);
  validate_attributes(mesh);
  require_options(options);
  require_vertices(mesh, region);
  report_progress(progress, "remesh", 0.0);
  OriginalPatch original = cut_patch(mesh, region);
  if (original.triangles.empty()) return unchanged(mesh);

  const TargetSizingField target(target_length);
  std::vector<double> lengths = lengths_at(original.positions, target);
  const double faces = expected_faces(original, lengths);
  require_reasonable(faces);
  find_feature_lines(mesh, options.feature_angle_degrees, lengths, original);
  const auto most_vertices =
      original.positions.size() + static_cast<std::size_t>(4.0 * faces) + 1000;

  WorkingPatch patch(original, target, std::move(lengths));
  bool all_split = true;
  for (int i = 0; i < options.iterations; ++i) {
    const auto report = [&](double share) {
      report_progress(progress, "remesh", (i + share) / options.iterations);
    };
    all_split = split_long_edges(patch, most_vertices);
    report(0.2);
    collapse_short_edges(patch);
    report(0.4);
    flip_for_valence(patch);
    report(0.6);
    for (int r = 0; r < kRelaxations; ++r) relax(patch);
    report(1.0);
  }
  flip_for_angles(patch);
  RemeshResult result = transfer_to_mesh(mesh, patch);
  if (!all_split) result.note = "some edges remain longer than the target length";
  return result;
}

}  // namespace lapwing
