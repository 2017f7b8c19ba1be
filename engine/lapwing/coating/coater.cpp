#include "lapwing/coating/coater.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/coating/coating.h"
#include "lapwing/coating/ring_operators.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/laplacian_system.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/region/submesh.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The Laplacians and the displacement of a coating, one entry per row.
struct Samples {
  std::vector<Vector3d> xi;
  std::vector<Vector3d> displacement;
};

}  // namespace

struct Coater::State {
  State(const CoatTarget& target, const Topology& mesh_topology, const Patch& target_patch,
        const CoaterOptions& coater_options, Kernels& device)
      : target_rest(target.rest),
        keeps_detail(target.smooth.empty() && !target.whole),
        whole(target.whole),
        part(submesh_around(target_patch.vertices, mesh_topology)),
        rest(part.own(target.rest)),
        smooth(target.smooth.empty() ? rest : part.own(target.smooth)),
        patch(target_patch),
        options(coater_options),
        kernels(device) {
    patch.vertices = part.region;
    for (const HeldVertex& anchor : target.held) {
      if (target_patch.own_number(anchor.vertex) == kNoIndex) {
        throw InputError("vertex " + std::to_string(anchor.vertex) +
                         " is held, but it is outside the target patch; enlarge the patch, or "
                         "release the vertex");
      }
      const VertexSet own = own_numbers(part, {anchor.vertex});
      held.push_back({own.front(), anchor.displacement});
    }
  }

  bool holds_long_waves() const;
  double hold_length_at(Index own) const;
  std::vector<double> holds_in_order(const std::vector<double>& W) const;
  void make_system(const Progress& progress);
  void make_frames();
  Columns solve_for(std::span<const Vector3d> y, std::span<const Vector3d> wanted);
  const HeldVertex* held_at(Index vertex) const;
  std::vector<Vector3d> handle_field();
  void solve_for_base();
  double whole_ratio(const Coating& coating) const;
  void add_layer(const CoatLayer& layer, const Progress& progress, Samples& sum);

  const RegionRings& rings() const { return system->rings(); }
  std::size_t unknown_count() const { return system->size(); }

  std::span<const Vector3d> target_rest;  // of the whole mesh
  bool keeps_detail;
  bool whole;
  // All members below use the vertex indices of this submesh.
  Submesh part;
  Positions rest;
  Positions smooth;
  std::vector<HeldVertex> held;
  Patch patch;
  CoaterOptions options;
  Kernels& kernels;
  StageTimings timings;

  Constraints constraints;
  VertexSet free;  // as vertices of the whole mesh
  std::unique_ptr<SystemPattern> pattern;
  std::unique_ptr<LaplacianSystem> system;
  std::vector<double> shares;       // f, per row of the rings
  std::vector<double> holds;        // W, per unknown in elimination order
  std::vector<Vector3d> positions;  // of the smooth target, per vertex of the rings
  std::vector<Vector3d> normals;
  Columns base;     // removes the target's detail and moves handles; may be empty
  Columns coating;  // adds the coating; empty before the first `take`
  std::vector<LayerScales> scales;
  double residual = 0.0;
};

bool Coater::State::holds_long_waves() const {
  return !whole && (options.hold_length > 0.0 || !options.hold_lengths.empty());
}

double Coater::State::hold_length_at(Index own) const {
  return options.hold_lengths.empty() ? options.hold_length : options.hold_lengths[own];
}

std::vector<double> Coater::State::holds_in_order(const std::vector<double>& W) const {
  std::vector<double> ordered;
  for (const int k : system->elimination_order()) ordered.push_back(W[static_cast<std::size_t>(k)]);
  return ordered;
}

void Coater::State::make_system(const Progress& progress) {
  EditRegion region;
  region.roi = patch.vertices;
  region.belt = border_of(patch);
  constraints = constraints_of(region, part.topology, 1.0, true);
  const VertexSet& unknowns = constraints.unknowns.vertices;
  if (unknowns.empty()) {
    throw InputError(
        "the target patch has no inner vertices to coat; choose a larger patch, or "
        "a finer mesh");
  }
  if (holds_long_waves()) {
    const auto weights = laplacian_weights(part.topology, rest, options.weights);
    const auto radii = squared_rings(part.topology.rings, weights, rest, unknowns);
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const double length = hold_length_at(patch.own_number(unknowns[k]));
      const double squared = radii[k] * std::pow(std::numbers::pi / length, 2);
      constraints.W[k] = squared * squared;
    }
  }
  for (const HeldVertex& anchor : held) {
    const Index k = constraints.unknowns.of_vertex[anchor.vertex];
    if (k != kNoIndex) constraints.W[k] = 1.0;
  }
  for (const Index own : unknowns) free.push_back(part.vertices[own]);
  report_progress(progress, "order", 0.0);
  const Stopwatch watch;
  pattern = std::make_unique<SystemPattern>(part.topology, region.roi, constraints.unknowns);
  pattern->order();
  timings.add("order", watch.elapsed_ms());
  report_progress(progress, "laplacian", 0.0);
  try {
    system =
        std::make_unique<LaplacianSystem>(rest, part.topology, region.roi, constraints, *pattern,
                                          EnergyTerms{options.weights, 0.0}, timings);
  } catch (const SolverError&) {  // its message uses the vertex indices of the submesh
    throw SolverError("the system of the target patch is singular near vertex " +
                      std::to_string(free.front()) +
                      "; run `lapwing check` to find degenerate triangles");
  }
  holds = holds_in_order(constraints.W);
}

void Coater::State::make_frames() {
  const auto by_own = fades(options.transition, patch, part.topology, rest);
  const std::size_t row_count = rings().row_count();
  for (std::size_t r = 0; r < row_count; ++r) {
    // If the whole target is replaced, the border rows do not change, so that the border fits the
    // surface outside.
    const bool stays = whole && r >= unknown_count();
    shares.push_back(stays ? 0.0 : by_own[patch.own_number(rings().vertices[r])]);
  }
  std::vector<Vector3d> all(rest.size(), Vector3d::Zero());
  vertex_normals(smooth, part.topology.triangles, part.topology.vertex_triangles, rings().vertices,
                 all);
  for (const Index v : rings().vertices) {
    positions.push_back(smooth[v]);
    normals.push_back(all[v]);
  }
}

// Solves (L'L + W) u = L' y + W d for u. `wanted` contains d, one entry per row.
Columns Coater::State::solve_for(std::span<const Vector3d> y, std::span<const Vector3d> wanted) {
  const std::size_t n = unknown_count();
  Columns b = transposed(rings(), y, n);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      b[axis * n + k] += holds[k] * wanted[k][static_cast<Eigen::Index>(axis)];
    }
  }
  Columns u = b;
  system->solve_in_elimination_order(u, 3);

  const Columns Au = transposed(rings(), laplacians(rings(), u, n), n);
  Columns r = b;
  for (std::size_t k = 0; k < 3 * n; ++k) r[k] -= Au[k] + holds[k % n] * u[k];
  residual = norm(b) > 0.0 ? norm(r) / norm(b) : 0.0;
  return u;
}

const HeldVertex* Coater::State::held_at(Index vertex) const {
  const auto found =
      std::lower_bound(held.begin(), held.end(), vertex,
                       [](const HeldVertex& anchor, Index v) { return anchor.vertex < v; });
  return found != held.end() && found->vertex == vertex ? &*found : nullptr;
}

// Returns, per row, the displacement that the handles alone cause, with W = 0 elsewhere. This field
// is then the target value of W, so that components with long wavelengths follow the handles.
std::vector<Vector3d> Coater::State::handle_field() {
  const std::size_t n = unknown_count();
  std::vector<Vector3d> field(rings().row_count(), Vector3d::Zero());
  if (held.empty() || !holds_long_waves()) return field;
  Constraints handles = constraints;
  for (std::size_t k = 0; k < handles.W.size(); ++k) {
    if (held_at(handles.unknowns.vertices[k]) == nullptr) handles.W[k] = 0.0;
  }
  const LaplacianSystem followed(rest, part.topology, patch.vertices, handles, *pattern,
                                 {options.weights, 0.0}, timings);
  const auto anchored = holds_in_order(handles.W);
  Columns u(3 * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const HeldVertex* anchor = held_at(rings().vertices[k]);
    if (anchor == nullptr) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      u[axis * n + k] = anchored[k] * anchor->displacement[static_cast<Eigen::Index>(axis)];
    }
  }
  followed.solve_in_elimination_order(u, 3);
  for (std::size_t k = 0; k < n; ++k) field[k] = Vector3d(u[k], u[n + k], u[2 * n + k]);
  return field;
}

// Solves for the surface without coating: removes the target's detail and moves the handles.
void Coater::State::solve_for_base() {
  if (keeps_detail && held.empty()) return;
  // The detail is 0 outside the patch, as for a coating.
  const auto detail = [&](Index own) -> Vector3d {
    const Index v = rings().vertices[own];
    if (!rings().is_row(own)) return Vector3d::Zero();
    return whole ? rest[v] : Vector3d(rest[v] - smooth[v]);
  };
  std::vector<Vector3d> y(rings().row_count());
  std::vector<Vector3d> wanted = handle_field();
  for (std::size_t r = 0; r < y.size(); ++r) {
    const Vector3d here = detail(static_cast<Index>(r));
    Vector3d xi = Vector3d::Zero();
    for (std::size_t e = rings().starts[r]; e < rings().starts[r + 1]; ++e) {
      xi += rings().weights[e] * (here - detail(rings().neighbours[e]));
    }
    y[r] = -shares[r] * xi;
    if (const HeldVertex* anchor = held_at(rings().vertices[r])) {
      wanted[r] = anchor->displacement;
    } else {
      wanted[r] -= shares[r] * here;
    }
  }
  base = solve_for(y, wanted);
}

Coater::Coater(const CoatTarget& target, const Topology& topology, const Patch& patch,
               const CoaterOptions& options, Kernels& kernels, const Progress& progress)
    : state_(std::make_unique<State>(target, topology, patch, options, kernels)) {
  state_->make_system(progress);
  const Stopwatch frames;
  state_->make_frames();
  state_->solve_for_base();
  state_->timings.add("target_frames", frames.elapsed_ms());
}

Coater::~Coater() = default;
Coater::Coater(Coater&&) noexcept = default;
Coater& Coater::operator=(Coater&&) noexcept = default;

// Returns the ratio of lengths on the target patch to lengths on the coating, computed from the
// areas.
double Coater::State::whole_ratio(const Coating& on) const {
  const double here = surface_area(patch.triangles, on_patch<Vector3d>(patch, smooth));
  return std::sqrt(here / surface_area(on.patch.triangles, on.smooth));
}

// Samples `layer`, rotates the samples into the target's frames and adds them to `sum`.
void Coater::State::add_layer(const CoatLayer& layer, const Progress& progress, Samples& sum) {
  std::vector<SurfacePoint> points;
  points.reserve(rings().vertices.size());
  for (const Index v : rings().vertices) {
    const Index own = patch.own_number(v);
    points.push_back(own == kNoIndex ? SurfacePoint::nowhere() : layer.points[own]);
  }
  const MappedRings mapped{rings(), points};
  const std::size_t rows = rings().row_count();

  report_progress(progress, "frames", 0.0);
  Stopwatch watch;
  std::vector<Matrix3d> T(rows);
  kernels.rotate_frames(mapped, {layer.coating.smooth, layer.coating.normals}, {positions, normals},
                        T);
  const double largest = kLargestLocalScale * whole_ratio(layer.coating);
  LayerScales reached;
  for (Matrix3d& t : T) {
    const double ratio = t.col(0).norm();
    // The target's ring is a single point and cannot represent a coating.
    if (ratio == 0.0) continue;
    if (layer.options.scale) {
      t *= *layer.options.scale / ratio;
    } else if (ratio > largest) {
      t *= largest / ratio;
      ++reached.held;
    }
  }
  timings.add("frames", watch.elapsed_ms());

  report_progress(progress, "sample", 0.0);
  watch.restart();
  Samples samples{sample_coating(mapped, layer.coating, layer.options.sampling, part.topology,
                                 options.weights, kernels),
                  std::vector<Vector3d>(rows)};
  kernels.sample_mapped_laplacians(mapped, MappedSampling::linear, layer.coating.displacement,
                                   samples.displacement);
  for (std::size_t r = 0; r < rows; ++r) {
    const double weight =
        layer.weights.empty() ? 1.0 : layer.weights[patch.own_number(rings().vertices[r])];
    sum.xi[r] += weight * shares[r] * (T[r] * samples.xi[r]);
    if (held_at(rings().vertices[r]) == nullptr) {
      sum.displacement[r] += weight * shares[r] * (T[r] * samples.displacement[r]);
    }
    reached.mean += T[r].col(0).norm();
  }
  reached.mean /= static_cast<double>(rows);
  scales.push_back(reached);
  timings.add("sample", watch.elapsed_ms());
}

void Coater::take(std::span<const CoatLayer> layers, const Progress& progress) {
  State& state = *state_;
  const std::size_t rows = state.rings().row_count();
  Samples sum{std::vector<Vector3d>(rows, Vector3d::Zero()),
              std::vector<Vector3d>(rows, Vector3d::Zero())};
  state.scales.clear();
  for (const CoatLayer& layer : layers) state.add_layer(layer, progress, sum);
  report_progress(progress, "solve", 0.0);
  const Stopwatch watch;
  state.coating = state.solve_for(sum.xi, sum.displacement);
  state.timings.add("solve", watch.elapsed_ms());
}

Positions Coater::coat(double amplitude) const {
  const State& state = *state_;
  const std::size_t n = state.unknown_count();
  Positions positions(state.target_rest.begin(), state.target_rest.end());
  const auto add = [&](const Columns& u, double share) {
    if (u.empty() || share == 0.0) return;
    for (std::size_t k = 0; k < n; ++k) {
      positions[state.part.vertices[state.rings().vertices[k]]] +=
          share * Vector3d(u[k], u[n + k], u[2 * n + k]);
    }
  };
  add(state.base, 1.0);
  add(state.coating, amplitude);
  return positions;
}

const std::vector<LayerScales>& Coater::scales() const {
  return state_->scales;
}
double Coater::largest_share() const {
  return *std::max_element(state_->shares.begin(), state_->shares.end());
}
double Coater::relative_residual() const {
  return state_->residual;
}
const VertexSet& Coater::free() const {
  return state_->free;
}
const StageTimings& Coater::timings() const {
  return state_->timings;
}

std::vector<double> fades(const Transition& transition, const Patch& patch,
                          const Topology& topology, std::span<const Eigen::Vector3d> positions) {
  std::vector<double> shares(patch.vertices.size(), 1.0);
  if (transition.width <= 0.0) return shares;
  const VertexSet border = border_of(patch);
  const auto distances = geodesic_distances(topology, positions, border, transition.width,
                                            vertex_mask(positions.size(), patch.vertices));
  for (std::size_t own = 0; own < shares.size(); ++own) {
    shares[own] = fade(transition, distances[patch.vertices[own]]);
  }
  return shares;
}

}  // namespace lapwing
