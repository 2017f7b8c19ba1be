// Based on: Sumner, Popovic, "Deformation transfer for triangle meshes", SIGGRAPH 2004, as a
// Poisson problem: Botsch, Sumner, Pauly, Gross, "Deformation transfer for detail-preserving
// surface editing", VMV 2006.
#include "lapwing/transfer/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/deform/modifiers/loose_parts.h"
#include "lapwing/mesh/seams.h"
#include "lapwing/region/joined_regions.h"
#include "lapwing/transfer/pose_maps.h"
#include "lapwing/transfer/target_graph.h"
#include "lapwing/wrap/alignment.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kTargetTrianglesPerTask = 256;
// Warn if more than this fraction of the target has no counterpart.
constexpr double kMuchUnmatched = 0.5;

// The point of the source that supplies the map of a target triangle.
struct MapPlace {
  Index triangle = kNoIndex;
  std::array<double, 3> weights{};
};

void require_counterparts(std::span<const SurfacePoint> counterparts, const Mesh& source,
                          const Mesh& target) {
  const Adjacency& rings = source.topology().rings;
  if (counterparts.size() != target.vertex_count()) {
    throw InputError("counterparts: there are " + std::to_string(counterparts.size()) +
                     ", but the target has " + std::to_string(target.vertex_count()) +
                     " vertices. Give one for each vertex.");
  }
  for (std::size_t v = 0; v < counterparts.size(); ++v) {
    const auto& [corners, weights] = counterparts[v];
    double sum = 0.0;
    for (const double w : weights) sum += w >= 0.0 ? w : std::nan("");
    const bool is_on_source = std::ranges::all_of(
        corners, [&](Index c) { return c < rings.row_count() && rings.size(c) > 0; });
    if (counterparts[v].is_nowhere() || (is_on_source && std::abs(sum - 1.0) < 1e-6)) continue;
    throw InputError("counterparts: that of vertex " + std::to_string(v) +
                     " is not a point of the source. Its corners must be vertices of its "
                     "triangles, and its weights at least 0 with the sum 1.");
  }
}

void require_on_source(std::span<const Vector3d> on_source, const Mesh& target) {
  if (on_source.size() != target.vertex_count()) {
    throw InputError("correspondence: there are " + std::to_string(on_source.size()) +
                     " positions on the source, but the target has " +
                     std::to_string(target.vertex_count()) +
                     " vertices. Give one for each vertex.");
  }
  for (std::size_t v = 0; v < on_source.size(); ++v) {
    if (on_source[v].allFinite() || target.topology().rings.size(v) == 0) continue;
    throw InputError("correspondence: the position of vertex " + std::to_string(v) +
                     " is not finite");
  }
}

// Returns the mesh with its seams joined.
const Mesh& surface_of(const Mesh& mesh, const JoinedSurface& joined) {
  return joined.empty() ? mesh : joined.surface;
}

void require_pose(const Topology& source, std::span<const Vector3d> posed,
                  const std::string& where) {
  if (posed.size() != source.vertex_count()) {
    throw InputError(where + ": it has " + std::to_string(posed.size()) +
                     " vertices, but the source at rest has " +
                     std::to_string(source.vertex_count()) +
                     ". A pose must have the same vertices in the same order.");
  }
  for (std::size_t v = 0; v < posed.size(); ++v) {
    if (source.rings.size(v) > 0 && !posed[v].allFinite()) {
      throw InputError(where + ": vertex " + std::to_string(v) + " is not finite");
    }
  }
}

bool have_same_faces(const Mesh& a, const Mesh& b) {
  return a.vertex_count() == b.vertex_count() && a.face_starts() == b.face_starts() &&
         a.face_vertices() == b.face_vertices();
}

// Returns the double area vector of a triangle.
Vector3d area_vector_of(const Triangle& t, std::span<const Vector3d> p) {
  return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
}

}  // namespace

struct TransferSolver::State {
  std::shared_ptr<const Topology> source_topology;
  Eigen::Affine3d into_target = Eigen::Affine3d::Identity();  // the frame of the target
  PoseMaps::Rest source_rest;
  JoinedSurface joined;
  std::shared_ptr<const Topology> topology;
  Positions rest;  // of the target
  std::vector<SurfacePoint> counterparts;
  std::vector<char> exists;          // whether a vertex has a counterpart
  Positions counterpart_rest;        // in the frame of the target
  std::vector<MapPlace> places;      // per triangle
  std::vector<double> vertex_areas;  // of vertices with a counterpart, otherwise 0
  std::optional<TargetGraph> graph;
  EditRegion loose_region;
  LooseParts loose;
  bool is_held = false;
  double unmatched_area = 0.0;
  std::optional<WrapReport> wrap_report;
  std::vector<std::string> warnings;

  void find_counterparts(const Mesh& source, const JoinedSurface& source_joined, const Mesh& target,
                         const TransferRequest& request, Kernels& kernels,
                         const Progress& progress);
  void align(const Mesh& source);
  Positions counterpart_positions(std::span<const Vector3d> in_target_frame) const;
  Positions in_target_frame(std::span<const Vector3d> positions) const;
  void find_places(std::span<const Vector3d> source_positions);
  std::vector<double> mapped_areas();
  std::vector<LinearMap> maps_of_triangles(std::span<const Vector3d> posed) const;
  void place(std::span<const Vector3d> counterpart_posed, std::span<Vector3d> u) const;
  TransferReport measure(std::span<const Vector3d> posed) const;
};

void TransferSolver::State::find_counterparts(const Mesh& source,
                                              const JoinedSurface& source_joined,
                                              const Mesh& target, const TransferRequest& request,
                                              Kernels& kernels, const Progress& progress) {
  const Mesh& from = surface_of(source, source_joined);
  const Mesh& onto = surface_of(target, joined);
  if (!request.counterparts.empty()) {
    require_counterparts(request.counterparts, source, target);
    counterparts = request.counterparts;
  } else if (!request.on_source.empty()) {
    require_on_source(request.on_source, target);
    counterparts = counterparts_on(from, onto.topology(), request.on_source);
  } else if (request.landmarks.empty() && have_same_faces(source, target)) {
    for (Index v = 0; v < target.vertex_count(); ++v) {
      counterparts.push_back(SurfacePoint::at_vertex(v));
    }
  } else {
    Wrapped wrapped = wrap(target, source, {request.landmarks, request.aligned}, kernels, progress);
    counterparts = std::move(wrapped.counterparts);
    wrap_report = wrapped.report;
    if (const auto why = why_failed(wrapped.report, onto.topology().triangles.size());
        !why.empty()) {
      warnings.push_back("the target was wrapped (template) onto the source (scan). " + why);
    }
  }
  if (!source_joined.empty()) {
    for (SurfacePoint& point : counterparts) {
      for (Index& corner : point.corners) corner = source_joined.leaders[corner];
    }
  }
  for (Index v = 0; v < counterparts.size(); ++v) {
    const bool is_used = topology->rings.size(v) > 0;
    exists.push_back(is_used && !counterparts[v].is_nowhere() ? 1 : 0);
  }
}

// Finds the similarity transformation that maps the counterparts to the target, and applies it to
// them.
void TransferSolver::State::align(const Mesh& source) {
  Positions from;
  Positions to;
  for (std::size_t v = 0; v < counterparts.size(); ++v) {
    if (exists[v] == 0) continue;
    from.push_back(counterparts[v].of(std::span<const Vector3d>(source.positions)));
    to.push_back(rest[v]);
  }
  try {
    into_target = align_points(from, to).map;
  } catch (const InputError&) {
    throw InputError(
        "Fewer than three vertices of the target have a counterpart on the source, or these lie "
        "on one line. Add landmarks, or give other counterparts.");
  }
}

Positions TransferSolver::State::in_target_frame(std::span<const Vector3d> positions) const {
  Positions mapped;
  for (const Vector3d& p : positions) mapped.push_back(into_target * p);
  return mapped;
}

Positions TransferSolver::State::counterpart_positions(std::span<const Vector3d> mapped) const {
  Positions positions(counterparts.size(), Vector3d::Zero());
  for (std::size_t v = 0; v < counterparts.size(); ++v) {
    if (exists[v] != 0) positions[v] = counterparts[v].of(mapped);
  }
  return positions;
}

// Takes the centroid of the counterparts of each target triangle's corners, and finds the closest
// point of the source. A triangle has no such point if a corner has no counterpart.
void TransferSolver::State::find_places(std::span<const Vector3d> source_positions) {
  const ClosestPoint surface(source_topology->triangles, source_positions);
  places.resize(topology->triangles.size());
  parallel_for(places.size(), kTargetTrianglesPerTask, [&](std::size_t begin, std::size_t end) {
    Index hint = kNoIndex;
    for (std::size_t t = begin; t < end; ++t) {
      const Triangle& c = topology->triangles[t];
      if (exists[c[0]] == 0 || exists[c[1]] == 0 || exists[c[2]] == 0) continue;
      const Vector3d centroid =
          (counterpart_rest[c[0]] + counterpart_rest[c[1]] + counterpart_rest[c[2]]) / 3.0;
      const TrianglePoint found =
          surface.find(0, centroid, area_vector_of(c, counterpart_rest), hint);
      hint = found.hint;
      if (source_rest.areas[found.triangle] > 0.0) places[t] = {found.triangle, found.weights};
    }
  });
}

// Returns the area of each target triangle that has a map, and 0 for all others.
std::vector<double> TransferSolver::State::mapped_areas() {
  double whole = 0.0;
  double mapped = 0.0;
  std::vector<double> areas(places.size(), 0.0);
  vertex_areas.assign(rest.size(), 0.0);
  for (std::size_t t = 0; t < places.size(); ++t) {
    const Triangle& corners = topology->triangles[t];
    const double area = 0.5 * area_vector_of(corners, rest).norm();
    whole += area;
    if (places[t].triangle != kNoIndex) mapped += areas[t] = area;
    for (const Index v : corners) vertex_areas[v] += exists[v] != 0 ? area : 0.0;
  }
  if (!(mapped > 0.0)) {
    throw InputError(
        "No triangle of the target has counterparts at all three corners. Add landmarks, or give "
        "other counterparts.");
  }
  unmatched_area = 1.0 - mapped / whole;
  return areas;
}

TransferSolver::TransferSolver(const Mesh& source, const Mesh& target,
                               const TransferRequest& request, Kernels& kernels,
                               const Progress& progress)
    : state_(std::make_unique<State>()) {
  const ProgressScope scope(progress);
  State& s = *state_;
  require_surface(source, "source");
  require_surface(target, "target");
  require_finite(source);
  require_finite(target);
  const JoinedSurface source_joined = joined_surface(source);
  s.source_topology = surface_of(source, source_joined).shared_topology();
  s.joined = joined_surface(target);
  s.topology = surface_of(target, s.joined).shared_topology();
  s.rest = target.positions;
  s.find_counterparts(source, source_joined, target, request, kernels, progress);
  report_progress(progress, "prepare", 0.0);
  s.align(source);
  const Positions source_rest = s.in_target_frame(source.positions);
  s.source_rest = PoseMaps::prepare(*s.source_topology, source_rest);
  s.counterpart_rest = s.counterpart_positions(source_rest);
  s.find_places(source_rest);
  std::vector<double> areas = s.mapped_areas();
  VertexSet held;
  if (request.held) {
    held = s.joined.empty() ? resolve(*request.held, target)
                            : resolve_leaders(*request.held, s.joined);
  }
  s.is_held = !held.empty();
  s.graph.emplace(*s.topology, s.rest, std::move(areas), held);
  for (const VertexSet& part : s.graph->loose()) s.loose_region.loose.push_back({part, {}});
  s.loose = LooseParts(s.loose_region, s.rest, *s.topology);
  if (s.unmatched_area > kMuchUnmatched && !s.wrap_report) {
    s.warnings.push_back(std::to_string(std::lround(100.0 * s.unmatched_area)) +
                         "% of the target has no counterpart on the source");
  }
}

TransferSolver::TransferSolver(TransferSolver&&) noexcept = default;
TransferSolver& TransferSolver::operator=(TransferSolver&&) noexcept = default;
TransferSolver::~TransferSolver() = default;

void require_pose(const Mesh& source, std::span<const Vector3d> posed, const std::string& where) {
  require_pose(source.topology(), posed, where);
}

std::vector<LinearMap> TransferSolver::State::maps_of_triangles(
    std::span<const Vector3d> posed) const {
  const PoseMaps source(*source_topology, source_rest, posed);
  std::vector<LinearMap> maps(places.size());
  parallel_for(maps.size(), kTargetTrianglesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      if (places[t].triangle != kNoIndex) {
        maps[t] = source.at(places[t].triangle, places[t].weights);
      }
    }
  });
  return maps;
}

// Translates the solved vertices so that those with a counterpart move, on average, as their
// counterparts do.
void TransferSolver::State::place(std::span<const Vector3d> counterpart_posed,
                                  std::span<Vector3d> u) const {
  Vector3d sum = Vector3d::Zero();
  double area = 0.0;
  for (const Index v : graph->solved()) {
    sum += vertex_areas[v] * (counterpart_posed[v] - counterpart_rest[v] - u[v]);
    area += vertex_areas[v];
  }
  for (const Index v : graph->solved()) u[v] += sum / area;
}

TransferReport TransferSolver::State::measure(std::span<const Vector3d> posed) const {
  Certificate certificate;
  measure_shape(graph->solved(), *topology, rest, posed, certificate);
  return {certificate.largest_rotation_degrees, certificate.flipped_triangles,
          certificate.edge_stretch, certificate.inside_out_share};
}

Transferred TransferSolver::solve(std::span<const Vector3d> posed, const std::string& where) const {
  const State& s = *state_;
  require_pose(*s.source_topology, posed, where);
  const Positions mapped = s.in_target_frame(posed);
  std::vector<LinearMap> maps = s.maps_of_triangles(mapped);
  check_cancelled();
  const std::vector<LinearMap> of_vertex = s.graph->complete(maps);
  const Positions counterpart_posed = s.counterpart_positions(mapped);
  std::vector<Vector3d> u =
      s.graph->solve(maps, of_vertex, {s.exists, s.counterpart_rest, counterpart_posed});
  check_cancelled();
  if (!s.is_held) s.place(counterpart_posed, u);
  s.loose.carry({}, {}, u);
  Transferred result{s.rest, {}};
  for (std::size_t v = 0; v < u.size(); ++v) result.positions[v] += u[v];
  result.report = s.measure(result.positions);
  if (!s.joined.empty()) s.joined.close(result.positions);
  return result;
}

const std::vector<SurfacePoint>& TransferSolver::counterparts() const {
  return state_->counterparts;
}
double TransferSolver::unmatched_area() const {
  return state_->unmatched_area;
}
const std::optional<WrapReport>& TransferSolver::wrap_report() const {
  return state_->wrap_report;
}
const std::vector<std::string>& TransferSolver::warnings() const {
  return state_->warnings;
}

}  // namespace lapwing
