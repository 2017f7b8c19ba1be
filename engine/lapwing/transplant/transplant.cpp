#include "lapwing/transplant/transplant.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/limits.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/edges.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/remesh/isotropic.h"
#include "lapwing/transplant/bridge.h"
#include "lapwing/transplant/join.h"
#include "lapwing/transplant/loop_curve.h"
#include "lapwing/transplant/placed_part.h"
#include "lapwing/transplant/reconstruct_seam.h"
#include "lapwing/transplant/seam_sizing_field.h"
#include "lapwing/transplant/seam_zone.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

BridgeLoop zip_loop_of(const Mesh& mesh, const BoundaryLoop& loop) {
  return bridge_loop(mesh.topology().triangles, mesh.positions, loop);
}

// The joined mesh before the seam is reconstructed.
struct Assembly {
  Mesh mesh;
  Positions geometry;                // smooth around the seam
  std::vector<Index> host_vertices;  // per vertex: the vertex of the host, or kNoIndex
  std::vector<double> depths;        // per vertex: distance on the part from its loop; 0 elsewhere
  double gap = 0.0;
  double depth = 0.0;  // largest distance on the part from its loop
};

class TransplantRun {
 public:
  TransplantRun(const Mesh& host, const Mesh& part, const std::string& part_name,
                const TransplantRequest& request, Kernels& kernels, const Progress& progress)
      : request_(request),
        host_mesh_(host),
        part_(part),
        part_name_(part_name),
        kernels_(kernels),
        progress_(progress) {}

  Transplanted run();

 private:
  template <class Body>
  void timed(const char* name, Body body) {
    stage(name, result_.timings, progress_, body);
  }
  void assemble();
  void measure_depths(const std::vector<Index>& part_vertices, const PlacedPart& part);
  void remesh();
  void take_over(RemeshResult& remeshed);
  TransplantHost host() const;
  TransplantJoined joined() const;
  TransplantOptions options();
  void narrow(TransplantOptions& chosen) const;
  void warn_narrowed(double from, double to);
  void reconstruct();
  void require_valid(const TransplantResult& seam) const;
  double seam_degrees(const Positions& positions) const;
  void hand_over(TransplantResult seam);

  const TransplantRequest& request_;
  const Mesh& host_mesh_;
  const Mesh& part_;
  const std::string& part_name_;
  Kernels& kernels_;
  const Progress& progress_;
  CutHole hole_;
  double hole_radius_ = 0.0;
  bool even_strip_ = true;
  Assembly joined_;
  Transplanted result_;
};

void TransplantRun::assemble() {
  TransplantReport& report = result_.report;
  PlacedPart part;
  timed("part", [&] {
    hole_ = cut_hole(request_.target_region, host_mesh_);
    part = place_part(request_, part_, host_mesh_, hole_);
  });
  for (std::string& note : part.notes) report.warnings.push_back({std::move(note)});
  timed("zip", [&] {
    const BridgeLoop host_loop = zip_loop_of(hole_.rest.mesh, hole_.rest_loop);
    const BridgeLoop part_loop = zip_loop_of(part.mesh, part.loop);
    const Bridge bridge = bridge_loops(host_loop, part_loop, request_.where);
    Joined joined =
        join(hole_.rest.mesh, hole_.rest_loop, part.mesh, part.loop, bridge, part_name_);
    for (const std::string& note : joined.notes) {
      report.warnings.push_back({request_.where + ": " + note});
    }
    joined_.mesh = std::move(joined.mesh);
    joined_.host_vertices.assign(joined_.mesh.vertex_count(), kNoIndex);
    for (Index v = 0; v < hole_.rest.vertices.size(); ++v) {
      joined_.host_vertices[v] = hole_.rest.vertices[v];
    }
    hole_radius_ = LoopCurve(host_loop.points, request_.where).length() / (2.0 * std::numbers::pi);
    joined_.gap = strip_width(bridge, host_loop.points, part_loop.points);
    even_strip_ = is_even(bridge, host_loop.points, part_loop.points);
    report.strip_triangles = bridge.triangles.size();
    report.welded = bridge.welded.size();
    measure_depths(joined.part_vertices, part);
  });
  report.part_vertices = part.mesh.vertex_count();
  report.host_loop = hole_.rest_loop.size();
  report.part_loop = part.loop.size();
  report.turned = part.turned;
  report.place = part.motion.matrix().topRows<3>();
}

// Measures the distances on the placed part, without the strip.
void TransplantRun::measure_depths(const std::vector<Index>& part_vertices,
                                   const PlacedPart& part) {
  const auto distances = geodesic_distances(part.mesh.topology(), part.mesh.positions, part.loop);
  joined_.depths.assign(joined_.mesh.vertex_count(), 0.0);
  for (std::size_t v = 0; v < distances.size(); ++v) {
    joined_.depths[part_vertices[v]] = distances[v];
    if (std::isfinite(distances[v])) joined_.depth = std::max(joined_.depth, distances[v]);
  }
}

// Returns the requested lengths, or defaults from the size of the hole. If the part is too short,
// scales all lengths down.
TransplantOptions TransplantRun::options() {
  const TransplantParameters& parameters = request_.parameters;
  TransplantOptions options;
  options.weights = parameters.weights;
  options.sampling = parameters.sampling;
  options.transition =
      parameters.transition.value_or(Transition{0.5 * hole_radius_, Transition::Profile::smooth});
  const double edge = mean_edge_length(joined_.mesh.topology().rings, joined_.mesh.positions);
  const auto padding_of = [&](double width) {
    return parameters.padding.value_or(0.5 * std::max(width, edge));
  };
  const auto belt_of = [&](double width) {
    return parameters.belt.value_or(std::max(0.25 * width, 1.5 * edge));
  };
  options.padding = padding_of(options.transition.width);
  options.belt = belt_of(options.transition.width);

  constexpr double kMostOfThePart = 0.8;
  const double needed = options.transition.width + options.padding + options.belt;
  const double share = kMostOfThePart * joined_.depth / needed;
  if (share < 1.0) {
    options.transition.width *= share;
    options.padding *= share;
    options.belt *= share;
    if (parameters.transition) {
      std::ostringstream text;
      text << request_.where << ": the part extends only " << joined_.depth
           << " from its loop, so the transition's width, padding and belt, together " << needed
           << ", were scaled by " << share << ". Choose a narrower \"transition\"";
      const double narrower = 0.9 * options.transition.width;
      const bool fits =
          narrower + padding_of(narrower) + belt_of(narrower) <= kMostOfThePart * joined_.depth;
      result_.report.warnings.push_back(
          {text.str(), fits ? Advice::set_transition_width : Advice::none, narrower});
    }
  }
  return options;
}

// Reduces a default width if holes or topological handles are close to the seam.
void TransplantRun::narrow(TransplantOptions& chosen) const {
  const TransplantParameters& parameters = request_.parameters;
  if (parameters.transition) return;
  const double width = width_that_fits(host(), joined(), chosen.transition.width);
  const double share = width / chosen.transition.width;
  if (share == 1.0) return;
  chosen.transition.width = width;
  if (!parameters.padding) chosen.padding *= share;
  if (!parameters.belt) chosen.belt *= share;
}

void TransplantRun::warn_narrowed(double from, double to) {
  std::ostringstream text;
  text << request_.where << ": the transition was narrowed from " << from << " to " << to
       << ", because it would reach another boundary or a topological handle. To choose the width "
          "yourself, set \"width\" of \"transition\"";
  result_.report.warnings.push_back({text.str(), Advice::set_transition_width, to});
}

void TransplantRun::remesh() {
  if (request_.parameters.remesh == Remeshing::none) return;
  const double width = result_.report.transition_width;
  const SeamSizingField lengths(joined_.geometry, joined_.mesh.topology(), joined_.host_vertices,
                                joined_.depths, width);
  if (even_strip_ && !lengths.asks_for_remeshing()) return;
  Limit limit = kMostSeamTriangles;
  limit.most = std::max(limit.most, static_cast<double>(joined_.mesh.topology().triangles.size()));
  require_at_most(limit, lengths.expected_triangles(joined_.geometry),
                  request_.where + ": the seam between mesh and part would get about",
                  "make the part smaller, give \"transition\" a smaller \"width\", or set "
                  "\"remesh\" to \"none\"");
  timed("remesh", [&] {
    // Remesh the smooth surface. Extra attributes interpolate the positions and depths of the
    // joined mesh.
    Mesh smooth = joined_.mesh;
    smooth.positions = joined_.geometry;
    auto& extras = smooth.edit_attributes().vertex_extras;
    extras.push_back({"depth", "double", 1, joined_.depths});
    extras.push_back({"place", "double", 3, {}});
    for (const Vector3d& p : joined_.mesh.positions) {
      extras.back().values.insert(extras.back().values.end(), p.begin(), p.end());
    }
    RemeshResult remeshed =
        remesh_isotropic(smooth, lengths.region(), std::cref(lengths), {}, progress_);
    if (!remeshed.note.empty()) {
      result_.report.warnings.push_back({request_.where + ": " + remeshed.note});
    }
    take_over(remeshed);
    result_.report.remeshed_vertices = remeshed.region.size();
  });
}

void TransplantRun::take_over(RemeshResult& remeshed) {
  std::vector<Index> host_vertices;
  for (const Index v : remeshed.kept) {
    host_vertices.push_back(v == kNoIndex ? kNoIndex : joined_.host_vertices[v]);
  }
  joined_.host_vertices = std::move(host_vertices);
  joined_.mesh = std::move(remeshed.mesh);
  joined_.geometry = joined_.mesh.positions;
  auto& extras = joined_.mesh.edit_attributes().vertex_extras;
  for (std::size_t v = 0; v < joined_.mesh.vertex_count(); ++v) {
    joined_.mesh.positions[v] = Vector3d(extras.back().values.data() + 3 * v);
  }
  extras.pop_back();
  joined_.depths = std::move(extras.back().values);
  extras.pop_back();
}

void TransplantRun::require_valid(const TransplantResult& seam) const {
  for (const Index v : seam.region) {
    if (seam.positions[v].allFinite()) continue;
    throw SolverError(
        request_.where + ": the result has a non-finite position at vertex " + std::to_string(v) +
            ", so the mesh is unchanged; run `lapwing check` on the part and on the mesh",
        {v});
  }
  if (seam.relative_residual <= kLargestResidual) return;
  std::ostringstream text;
  text << request_.where << ": the relative residual of the solution is " << seam.relative_residual
       << ", above the limit of " << kLargestResidual
       << ", so the mesh is unchanged; remesh both meshes around the seam with `lapwing remesh`";
  throw SolverError(text.str());
}

TransplantHost TransplantRun::host() const {
  return {host_mesh_.positions, host_mesh_.topology(), hole_.triangles, hole_.loop};
}

// The host's faces come first, also after remeshing.
TransplantJoined TransplantRun::joined() const {
  return {joined_.mesh.positions,
          joined_.mesh.topology(),
          joined_.geometry,
          joined_.host_vertices,
          hole_.rest.mesh.face_count(),
          joined_.depths,
          joined_.gap};
}

void TransplantRun::reconstruct() {
  TransplantReport& report = result_.report;
  TransplantOptions chosen = options();
  const double wanted = chosen.transition.width;
  timed("smooth", [&] {
    narrow(chosen);
    joined_.geometry = smooth_seam(host(), joined(), chosen);
  });
  report.transition_width = chosen.transition.width;
  report.padding = chosen.padding;
  report.belt = chosen.belt;
  remesh();
  // Remeshing may have changed the surface next to a hole of the part.
  narrow(chosen);
  report.transition_width = chosen.transition.width;
  if (chosen.transition.width < wanted) warn_narrowed(wanted, chosen.transition.width);
  TransplantResult seam = reconstruct_seam(host(), joined(), chosen, kernels_, request_.where,
                                           result_.timings, progress_);
  require_valid(seam);
  if (!seam.sampled_host) {
    report.warnings.push_back(
        {request_.where +
             ": the target region or the part has no inner vertices whose detail could be blended, "
             "so "
             "the seam is only smooth; choose a larger \"target_region\" to blend detail",
         Advice::enlarge_hole});
  }
  hand_over(std::move(seam));
}

// Returns the 99th percentile of the angles between face normals at edges with an end on the rim.
double TransplantRun::seam_degrees(const Positions& positions) const {
  std::vector<char> on_rim(host_mesh_.vertex_count(), 0);
  for (const Index v : hole_.loop) on_rim[v] = 1;
  const auto is_seam = [&](Index v) {
    const Index host = joined_.host_vertices[v];
    return host != kNoIndex && on_rim[host] != 0;
  };
  std::vector<double> degrees;
  const auto& triangles = joined_.mesh.topology().triangles;
  const auto normal = [&](Index t) {
    const auto& [a, b, c] = triangles[t];
    return (positions[b] - positions[a]).cross(positions[c] - positions[a]).stableNormalized();
  };
  const Adjacency edges = sides_by_edge(triangles, positions.size());
  for (std::size_t e = 0; e < edges.row_count(); ++e) {
    const auto sides = edges[e];
    if (sides.size() != 2 ||
        !(is_seam(side_start(triangles, sides[0])) || is_seam(side_end(triangles, sides[0])))) {
      continue;
    }
    const double cosine = normal(sides[0] / 3).dot(normal(sides[1] / 3));
    degrees.push_back(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi);
  }
  if (degrees.empty()) return 0.0;
  const auto place = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(degrees.size() - 1));
  std::nth_element(degrees.begin(), degrees.begin() + place, degrees.end());
  return degrees[static_cast<std::size_t>(place)];
}

// Moves the reconstructed mesh into the result and completes the report.
void TransplantRun::hand_over(TransplantResult seam) {
  TransplantReport& report = result_.report;
  for (std::size_t v = 0; v < seam.positions.size(); ++v) {
    const double distance = (seam.positions[v] - joined_.mesh.positions[v]).norm();
    if (distance <= report.largest_displacement) continue;
    report.largest_displacement = distance;
    report.largest_displacement_vertex = static_cast<Index>(v);
  }
  report.seam_degrees = seam_degrees(seam.positions);
  report.relative_residual = seam.relative_residual;
  report.last_change = seam.last_change;
  report.flipped = seam.flipped;
  result_.region = std::move(seam.region);
  result_.belt = std::move(seam.belt);
  result_.host_vertices = std::move(joined_.host_vertices);
  result_.mesh = std::move(joined_.mesh);
  result_.placed = std::exchange(result_.mesh.positions, std::move(seam.positions));
}

Transplanted TransplantRun::run() {
  assemble();
  reconstruct();
  return std::move(result_);
}

}  // namespace

Transplanted transplant(const Mesh& host, const Mesh& part, const std::string& part_name,
                        const TransplantRequest& request, Kernels& kernels,
                        const Progress& progress) {
  const ProgressScope scope(progress);
  return TransplantRun{host, part, part_name, request, kernels, progress}.run();
}

Transplanted transplant(const Mesh& host, const Mesh& part, const TransplantRequest& request) {
  CpuKernels kernels;
  return transplant(host, part, "part", request, kernels);
}

}  // namespace lapwing
