#include "lapwing/elastic/drag_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_ring_rotations.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kVerticesPerTask = 1024;

// The matrix N of the energy at fixed rotations over the unknowns, for one coordinate.
class EnergyMatrix {
 public:
  explicit EnergyMatrix(const RegionRings& rings) : rings_(rings), laplacians_(rings.row_count()) {}

  std::vector<double> diagonal() const {
    std::vector<double> diagonal(rings_.unknown_rows.size());
    for_unknowns([&](std::size_t k, Index row) {
      double sum = rings_.row_weights[row];
      for (std::size_t e = rings_.starts[row]; e < rings_.starts[row + 1]; ++e) {
        const Index j = rings_.neighbours[e];
        if (rings_.is_row(j)) {
          sum += rings_.reverse_weights[e] * rings_.reverse_weights[e] * rings_.row_weights[j];
        }
        sum += edge_stiffness(e);
      }
      diagonal[k] = sum;
    });
    return diagonal;
  }

  // Computes y = N x. `x` has one number per vertex of the rings, and `y` one per unknown.
  void multiply(std::span<const double> x, std::span<double> y) {
    parallel_for(rings_.row_count(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) {
        double sum = x[r];
        for (std::size_t e = rings_.starts[r]; e < rings_.starts[r + 1]; ++e) {
          sum -= rings_.weights[e] * x[rings_.neighbours[e]];
        }
        laplacians_[r] = rings_.row_weights[r] * sum;
      }
    });
    for_unknowns([&](std::size_t k, Index row) {
      double sum = laplacians_[row];
      for (std::size_t e = rings_.starts[row]; e < rings_.starts[row + 1]; ++e) {
        const Index j = rings_.neighbours[e];
        if (rings_.is_row(j)) sum -= rings_.reverse_weights[e] * laplacians_[j];
        sum += edge_stiffness(e) * (x[row] - x[j]);
      }
      y[k] = sum;
    });
  }

 private:
  template <typename Visit>
  void for_unknowns(const Visit& visit) const {
    parallel_for(rings_.unknown_rows.size(), kVerticesPerTask,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t k = begin; k < end; ++k) visit(k, rings_.unknown_rows[k]);
                 });
  }
  // Each edge between two rows occurs in both of their rings.
  double edge_stiffness(std::size_t entry) const {
    if (rings_.stiffness.empty()) return 0.0;
    return (rings_.is_row(rings_.neighbours[entry]) ? 2.0 : 1.0) * rings_.stiffness[entry];
  }

  const RegionRings& rings_;
  std::vector<double> laplacians_;
};

// Returns an estimate of the largest eigenvalue of D^-1 N that is rarely too small.
double largest_eigenvalue(const RegionRings& rings, EnergyMatrix& matrix,
                          std::span<const double> inverse_diagonal) {
  constexpr int kIterations = 20;
  constexpr double kMargin = 1.1;
  std::vector<double> x(rings.vertices.size(), 0.0);
  std::vector<double> y(rings.unknown_rows.size());
  // The largest eigenvalues belong to vectors that oscillate from vertex to vertex.
  for (std::size_t k = 0; k < y.size(); ++k) y[k] = std::sin(2.4 * static_cast<double>(k * k % 97));
  double length = 0.0;
  for (int iteration = 0; iteration <= kIterations; ++iteration) {
    double square = 0.0;
    for (std::size_t k = 0; k < y.size(); ++k) {
      if (iteration > 0 || inverse_diagonal[k] == 0.0) y[k] *= inverse_diagonal[k];
      square += y[k] * y[k];
    }
    length = std::sqrt(square);
    if (!(length > 0.0)) return 1.0;
    for (std::size_t k = 0; k < y.size(); ++k) x[rings.unknown_rows[k]] = y[k] / length;
    if (iteration < kIterations) matrix.multiply(x, y);
  }
  return kMargin * length;
}

// Returns sweeps that damp all eigenvectors with eigenvalues from 1/30 of `largest` to `largest`
// (Saad, "Iterative methods for sparse linear systems", algorithm 12.1). Smaller eigenvalues belong
// to smooth vectors, which the coarse surface minimizes.
std::array<Sweep, kSweepsPerFrame> chebyshev_sweeps(double largest) {
  constexpr double kDampedRange = 30.0;
  const double smallest = largest / kDampedRange;
  const double centre = 0.5 * (largest + smallest);
  const double radius = 0.5 * (largest - smallest);
  std::array<Sweep, kSweepsPerFrame> sweeps{};
  double rho = radius / centre;
  sweeps[0] = {static_cast<float>(1.0 / centre), 0.0F};
  for (std::size_t k = 1; k < sweeps.size(); ++k) {
    const double next = 1.0 / (2.0 * centre / radius - rho);
    sweeps[k] = {static_cast<float>(2.0 * next / radius), static_cast<float>(next * rho)};
    rho = next;
  }
  return sweeps;
}

}  // namespace

EmbeddedVertex with_rounded_weights(const EmbeddedVertex& embedded) {
  constexpr double kUnits = DragFrameProblem::kWeightUnits;
  EmbeddedVertex rounded = embedded;
  double sum = 0.0;
  double rounded_sum = 0.0;
  for (double& weight : rounded.weights) {
    sum += weight;
    weight = std::round(weight * kUnits);
    rounded_sum += weight;
  }
  *std::ranges::max_element(rounded.weights) += std::round(sum * kUnits) - rounded_sum;
  for (double& weight : rounded.weights) weight /= kUnits;
  return rounded;
}

void DragFrameProblem::set_sweeps(std::span<const char> moves) {
  EnergyMatrix matrix(*rings);
  inverse_diagonal = matrix.diagonal();
  for (std::size_t k = 0; k < inverse_diagonal.size(); ++k) {
    const Index entry = prescribed_entries[rings->unknown_rows[k]];
    const double diagonal = inverse_diagonal[k] + (entry == kNoIndex ? 0.0 : stiffness[entry]);
    inverse_diagonal[k] = moves[k] != 0 && diagonal > 0.0 ? 1.0 / diagonal : 0.0;
  }
  sweeps = chebyshev_sweeps(largest_eigenvalue(*rings, matrix, inverse_diagonal));
}

CpuDragFrame::CpuDragFrame(std::shared_ptr<const DragFrameProblem> problem)
    : problem_(std::move(problem)),
      rotations_(std::make_unique<CpuRingRotations>(problem_->rings)),
      gradient_(3 * problem_->rings->unknown_rows.size()),
      energies_(problem_->rings->row_count()) {}

void CpuDragFrame::begin(std::vector<Vector3d> displacement) {
  displacement_ = std::move(displacement);
  last_ = displacement_;
}

void CpuDragFrame::step(const DragFrameInput& input) {
  prolongate(input);
  last_ = displacement_;
  for (const Sweep& sweep : problem_->sweeps) smooth(sweep, input);
}

void CpuDragFrame::prolongate(const DragFrameInput& input) {
  const DragFrameProblem& problem = *problem_;
  parallel_for(displacement_.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Index entry = problem.prescribed_entries[v];
      if (entry < problem.exact_count) {
        displacement_[v] = input.prescribed[entry];
        continue;
      }
      const EmbeddedVertex& embedded = problem.embedded[v];
      Eigen::Matrix<double, 3, 4> motion = Eigen::Matrix<double, 3, 4>::Zero();
      for (std::size_t node = 0; node < kEmbeddingNodes; ++node) {
        motion +=
            embedded.weights[node] * Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(
                                         input.motions[embedded.nodes[node]].row[0]);
      }
      displacement_[v] += motion * (problem.rest[v] + displacement_[v]).homogeneous();
    }
  });
}

void CpuDragFrame::smooth(const Sweep& sweep, const DragFrameInput& input) {
  const DragFrameProblem& problem = *problem_;
  const RegionRings& rings = *problem.rings;
  rotations_->fit_rotations(std::span(displacement_).first(rings.vertices.size()), energies_);
  rotations_->energy_gradient(gradient_);
  const std::size_t n = rings.unknown_rows.size();
  parallel_for(n, kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const double inverse = problem.inverse_diagonal[k];
      if (inverse == 0.0) continue;
      const Index v = rings.unknown_rows[k];
      Vector3d g(gradient_[k], gradient_[n + k], gradient_[2 * n + k]);
      const Index entry = problem.prescribed_entries[v];
      if (entry != kNoIndex) {
        g += problem.stiffness[entry] * (displacement_[v] - input.prescribed[entry]);
      }
      const Vector3d next = displacement_[v] +
                            double{sweep.momentum} * (displacement_[v] - last_[v]) -
                            double{sweep.step} * inverse * g;
      last_[v] = std::exchange(displacement_[v], next);
    }
  });
}

}  // namespace lapwing
