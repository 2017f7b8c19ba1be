// Based on: Sorkine, Cohen-Or, Lipman, Alexa, Roessl, Seidel, "Laplacian Surface Editing", SGP
// 2004, section 3.1, alternated as in Sorkine, Alexa, "As-Rigid-As-Possible Surface Modeling", SGP
// 2007; accelerated after Peng et al., "Anderson Acceleration for Geometry Optimization", 2018.
#include "lapwing/settle/settle.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/laplacian/ring_fit.h"
#include "lapwing/settle/anderson.h"
#include "lapwing/solve/block_solver.h"
#include "lapwing/solve/ordering.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kRowsPerTask = 512;
constexpr int kWindow = 5;
// Rounding alone moves the energy by about this share of what it is made of.
constexpr double kEnergyRounding = 1e-12;

void check(const SettleOptions& options) {
  const auto require = [](bool holds, const char* what, double value) {
    if (!holds) throw InputError(std::string(what) + ", not " + std::to_string(value));
  };
  require(options.tolerance > 0.0 && std::isfinite(options.tolerance),
          "the tolerance of settling must be a positive number", options.tolerance);
  require(options.stretch_resistance >= 0.0 && std::isfinite(options.stretch_resistance),
          "the stretch resistance must be 0 or more", options.stretch_resistance);
  require(options.max_iterations >= 1, "settling needs at least one iteration",
          options.max_iterations);
}

}  // namespace

struct Settler::State {
  const Topology& topology;
  const Constraints& constraints;
  SettleOptions options;
  Positions rest;
  std::vector<Index> roi;
  std::vector<Index> row_of;  ///< vertex -> row, or kNoIndex outside the region
  double mean_edge = 1.0;
  std::vector<double> edges;    ///< w_ij; empty for mu = 0
  std::vector<Vector3d> delta;  ///< per row
  double scale_of_energy = 0.0;
  BlockRows L;
  std::unique_ptr<NormalPattern> pattern;
  std::unique_ptr<BlockSolver> solver;
  Anderson anderson;

  // Of one iteration, kept so that it allocates nothing.
  std::vector<Matrix3d> T;         ///< per row: R_i or s_i R_i
  std::vector<double> row_energy;  ///< per row, then per unknown
  std::vector<Vector3d> current;   ///< of the whole mesh
  std::vector<double> rows;        ///< 3 per row
  std::vector<double> gathered;    ///< 3 per unknown
  std::vector<double> right;       ///< x of all unknowns, then y, then z
  std::vector<double> x;           ///< 3 per unknown
  std::vector<double> g;           ///< 3 per unknown

  State(std::span<const Vector3d> positions, const Topology& t, std::span<const Index> region,
        const Constraints& c, const SettleOptions& o)
      : topology(t),
        constraints(c),
        options(o),
        rest(positions.begin(), positions.end()),
        roi(region.begin(), region.end()),
        row_of(positions.size(), kNoIndex),
        anderson(3 * c.unknowns.size(), kWindow) {}

  std::size_t unknown_count() const { return constraints.unknowns.size(); }
  void set_up_rows();
  void factor(const Progress& progress, StageTimings& timings);
  void add_edge_terms(BlockMatrix& A) const;
  void scatter(std::span<const double> from, std::span<Vector3d> u) const;
  double fit_rotations(std::span<const Vector3d> wanted, std::span<const Vector3d> u);
  void global_step(std::span<const Vector3d> wanted, std::span<const Vector3d> u);
  Vector3d edge_forces(Index i, std::span<const Vector3d> given) const;
  double largest_step() const;
};

void Settler::State::set_up_rows() {
  for (std::size_t r = 0; r < roi.size(); ++r) row_of[roi[r]] = static_cast<Index>(r);
  mean_edge = mean_edge_length(topology.rings, rest);
  if (!(mean_edge > 0.0)) mean_edge = 1.0;
  L = laplacian_rows(topology.rings, laplacian_weights(topology, rest, options.weights), roi);
  rows.resize(3 * roi.size());
  // Differences from one vertex: positions far from the origin lose nothing.
  for (std::size_t r = 0; r < roi.size(); ++r) {
    Vector3d d = Vector3d::Zero();
    for (std::size_t b = L.starts[r]; b < L.starts[r + 1]; ++b) {
      d += L.values[b] * (rest[L.columns[b]] - rest[roi[r]]);
    }
    delta.push_back(d);
    scale_of_energy += d.squaredNorm();
  }
  if (options.stretch_resistance > 0.0) {
    edges = edge_weights(topology, rest);
    // Each end of an edge holds it by half.
    for (double& w : edges) w *= 0.5 * options.stretch_resistance;
  }
  T.assign(roi.size(), Matrix3d::Identity());
  row_energy.resize(roi.size() + unknown_count());
  current.resize(rest.size());
  for (auto* v : {&gathered, &right, &x, &g}) v->resize(3 * unknown_count());
}

// K: every ring of the region holds its edges, so an edge inside the region counts twice.
void Settler::State::add_edge_terms(BlockMatrix& A) const {
  const BlockPattern& blocks = *A.pattern;
  const Adjacency& rings = topology.rings;
  for (std::size_t c = 0; c < unknown_count(); ++c) {
    const Index i = constraints.unknowns.vertices[c];
    for (std::size_t k = 0; k < rings.size(i); ++k) {
      const Index j = rings[i][k];
      const double w = edges[rings.starts[i] + k] * (row_of[j] == kNoIndex ? 1.0 : 2.0);
      A.values[blocks.starts[c]] += w;
      const Index r = constraints.unknowns.of_vertex[j];
      if (r == kNoIndex || r < c) continue;
      const auto column = blocks.column(c);
      const auto at = std::lower_bound(column.begin(), column.end(), r) - column.begin();
      A.values[blocks.starts[c] + static_cast<std::size_t>(at)] -= w;
    }
  }
}

void Settler::State::factor(const Progress& progress, StageTimings& timings) {
  report_progress(progress, "settle_matrix", 0.0);
  Stopwatch watch;
  set_up_rows();
  pattern = std::make_unique<NormalPattern>(L, constraints.unknowns);
  BlockMatrix A = pattern->normal_matrix(L, constraints.W);
  if (!edges.empty()) add_edge_terms(A);
  timings.add("settle_matrix", watch.elapsed_ms());

  report_progress(progress, "settle_factor", 0.0);
  watch.restart();
  solver = make_solver();
  solver->analyze(pattern->blocks(), 1, fill_reducing_order(pattern->blocks()));
  try {
    solver->factor(A);
  } catch (const NotPositiveDefinite& error) {
    throw SolverError("settling is singular at vertex " +
                      std::to_string(constraints.unknowns.vertices[error.block]) +
                      ": belt and handle do not hold its component. Add belt vertices there, or "
                      "leave it out of the region");
  }
  timings.add("settle_factor", watch.elapsed_ms());
}

void Settler::State::scatter(std::span<const double> from, std::span<Vector3d> u) const {
  for (std::size_t k = 0; k < unknown_count(); ++k) {
    u[constraints.unknowns.vertices[k]] = Eigen::Map<const Vector3d>(from.data() + 3 * k);
  }
}

// The local step; returns the energy of u with the rotations found.
double Settler::State::fit_rotations(std::span<const Vector3d> wanted,
                                     std::span<const Vector3d> u) {
  parallel_for(rest.size(), 4 * kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) current[v] = rest[v] + u[v];
  });
  parallel_for(roi.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Index i = roi[r];
      const auto ring = topology.rings[i];
      T[r] = fit_rotation(i, ring, rest, current);
      if (options.details == Details::follow) T[r] *= fit_scale(i, ring, rest, current, T[r]);
      Vector3d Lu = Vector3d::Zero();
      for (std::size_t b = L.starts[r]; b < L.starts[r + 1]; ++b) {
        Lu += L.values[b] * u[L.columns[b]];
      }
      double energy = (Lu - (T[r] * delta[r] - delta[r])).squaredNorm();
      if (!edges.empty()) {
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const Vector3d was = rest[i] - rest[ring[k]];
          const Vector3d off = u[i] - u[ring[k]] - (T[r] * was - was);
          energy += edges[topology.rings.starts[i] + k] * off.squaredNorm();
        }
      }
      row_energy[r] = energy;
    }
  });
  for (std::size_t k = 0; k < unknown_count(); ++k) {
    const Index v = constraints.unknowns.vertices[k];
    row_energy[roi.size() + k] =
        constraints.W[k] == 0.0 ? 0.0 : constraints.W[k] * (u[v] - wanted[v]).squaredNorm();
  }
  return std::accumulate(row_energy.begin(), row_energy.end(), 0.0);
}

// What edges ask of unknown i, without the part of the matrix.
Vector3d Settler::State::edge_forces(Index i, std::span<const Vector3d> given) const {
  const auto ring = topology.rings[i];
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Index j = ring[k];
    const double w = edges[topology.rings.starts[i] + k];
    const Vector3d was = rest[i] - rest[j];
    const Matrix3d& T_i = T[row_of[i]];
    Vector3d wish = T_i * was - was;
    double count = 1.0;
    if (row_of[j] != kNoIndex) {
      wish += T[row_of[j]] * was - was;
      count = 2.0;
      if (constraints.unknowns.of_vertex[j] == kNoIndex) wish += count * given[j];
    }
    sum += w * wish;
  }
  return sum;
}

// g = argmin over u with the rotations fixed. Given displacements are read from `u`.
void Settler::State::global_step(std::span<const Vector3d> wanted, std::span<const Vector3d> u) {
  parallel_for(roi.size(), 4 * kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      Vector3d row = T[r] * delta[r] - delta[r];
      for (std::size_t b = L.starts[r]; b < L.starts[r + 1]; ++b) {
        const Index j = L.columns[b];
        if (constraints.unknowns.of_vertex[j] == kNoIndex) row -= L.values[b] * u[j];
      }
      Eigen::Map<Vector3d>(rows.data() + 3 * r) = row;
    }
  });
  pattern->multiply_transposed(L, rows, gathered);
  const std::size_t n = unknown_count();
  parallel_for(n, kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Index v = constraints.unknowns.vertices[k];
      Vector3d b = Eigen::Map<const Vector3d>(gathered.data() + 3 * k);
      if (constraints.W[k] != 0.0) b += constraints.W[k] * wanted[v];
      if (!edges.empty()) b += edge_forces(v, u);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        right[axis * n + k] = b[static_cast<Eigen::Index>(axis)];
      }
    }
  });
  solver->solve(right, right, 3);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) g[3 * k + axis] = right[axis * n + k];
  }
}

// How far a vertex moves from x to g, in mean edge lengths.
double Settler::State::largest_step() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < unknown_count(); ++k) {
    const Vector3d step =
        Eigen::Map<const Vector3d>(g.data() + 3 * k) - Eigen::Map<const Vector3d>(x.data() + 3 * k);
    largest = std::max(largest, step.squaredNorm());
  }
  return std::sqrt(largest) / mean_edge;
}

Settler::Settler(std::span<const Vector3d> rest, const Topology& topology,
                 std::span<const Index> roi, const Constraints& constraints,
                 const SettleOptions& options, const Progress& progress, StageTimings& timings) {
  check(options);
  state_ = std::make_unique<State>(rest, topology, roi, constraints, options);
  state_->factor(progress, timings);
}

Settler::~Settler() = default;
Settler::Settler(Settler&&) noexcept = default;
Settler& Settler::operator=(Settler&&) noexcept = default;

SettleResult Settler::settle(std::span<const Vector3d> wanted, std::span<Vector3d> u,
                             const Progress& progress) {
  State& s = *state_;
  SettleResult result;
  if (s.unknown_count() == 0) {
    result.settled = true;
    return result;
  }
  for (std::size_t k = 0; k < s.unknown_count(); ++k) {
    Eigen::Map<Vector3d>(s.x.data() + 3 * k) = u[s.constraints.unknowns.vertices[k]];
  }
  s.anderson.restart();
  double energy = s.fit_rotations(wanted, u);
  while (result.iterations < s.options.max_iterations) {
    report_progress(progress, "settle",
                    static_cast<double>(result.iterations) / s.options.max_iterations);
    s.global_step(wanted, u);
    ++result.iterations;
    result.last_step = s.largest_step();
    if (result.last_step <= s.options.tolerance) {
      s.scatter(s.g, u);
      result.settled = true;
      result.energy = s.fit_rotations(wanted, u);
      return result;
    }
    // The plain step never raises the energy; the accelerated one is kept only if it does not.
    if (s.options.accelerate) {
      s.anderson.advance(s.x, s.g);
      s.scatter(s.x, u);
      const double accelerated = s.fit_rotations(wanted, u);
      if (accelerated <= energy + kEnergyRounding * s.scale_of_energy) {
        energy = accelerated;
        continue;
      }
      s.anderson.restart();
    }
    s.x = s.g;
    s.scatter(s.x, u);
    energy = s.fit_rotations(wanted, u);
  }
  result.energy = energy;
  return result;
}

}  // namespace lapwing
