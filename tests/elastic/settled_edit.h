#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "support/bent_tube.h"
#include "support/linear_options.h"
#include "support/rippled_cylinder.h"

namespace lapwing::test {

enum class Start { linear, rest };

struct Settled {
  Positions positions;
  MinimizerResult result;
};

inline const EnergyTerms kTerms{LaplacianWeights::cotangent, kDefaultDetailLength};

/// A region of a mesh that is settled, by the engine as a user gets it or by a EnergyMinimizer
/// alone.
class SettledEdit {
 public:
  SettledEdit(Mesh mesh, EditRegion region)
      : mesh_(std::move(mesh)), topology_(mesh_.topology()), region_(std::move(region)) {}

  const Mesh& mesh() const { return mesh_; }
  const Topology& topology() const { return topology_; }
  const EditRegion& region() const { return region_; }

  Positions linear(const Eigen::Affine3d& motion) const {
    CpuKernels kernels;
    const DeformSolver deformer(mesh_.positions, topology_, region_, linear_options(), kernels);
    return deformer.solve(std::vector(region_.handles.size(), motion)).positions;
  }

  /// As a user gets it: from the start that DeformSolver chooses.
  DeformResult deform(const Eigen::Affine3d& motion, const DeformOptions& options = {}) const {
    CpuKernels kernels;
    const DeformSolver deformer(mesh_.positions, topology_, region_, options, kernels);
    return deformer.solve(std::vector(region_.handles.size(), motion));
  }

  using TangentOf = std::function<std::unique_ptr<Preconditioner>(const LaplacianSystem&)>;

  Settled settle(
      const Eigen::Affine3d& motion, const SettleOptions& options = {}, Start start = Start::linear,
      bool hard = false, const EnergyTerms& terms = kTerms,
      const std::function<void(std::function<void()>)>& run = [](auto settle) { settle(); },
      const TangentOf& tangent_of = [](const auto&) { return nullptr; }) const {
    const Constraints constraints = constraints_of(region_, topology_, 1.0, hard);
    StageTimings timings;
    const SystemPattern pattern(topology_, region_.roi, constraints.unknowns);
    const LaplacianSystem system(mesh_.positions, topology_, region_.roi, constraints, pattern,
                                 terms, timings);
    CpuKernels kernels;
    const std::unique_ptr<Preconditioner> tangent = tangent_of(system);
    EnergyMinimizer settler(kernels, system, options, tangent.get());
    std::vector<Eigen::Vector3d> prescribed(mesh_.vertex_count(), Eigen::Vector3d::Zero());
    for (const auto& handle : region_.handles) {
      for (const Index v : handle) prescribed[v] = motion * mesh_.positions[v] - mesh_.positions[v];
    }
    std::vector<Eigen::Vector3d> u(mesh_.vertex_count(), Eigen::Vector3d::Zero());
    if (start == Start::linear) {
      const Positions there = linear(motion);
      for (std::size_t i = 0; i < u.size(); ++i) u[i] = there[i] - mesh_.positions[i];
    }
    Settled settled{mesh_.positions, {}};
    const std::vector<Eigen::Vector3d> begin = u;
    run([&] {
      std::copy(begin.begin(), begin.end(), u.begin());
      settled.result = settler.settle({prescribed}, u);
    });
    for (std::size_t i = 0; i < u.size(); ++i) settled.positions[i] += u[i];
    return settled;
  }

  std::vector<Index> free_vertices() const {
    const Constraints constraints = constraints_of(region_, topology_, 1.0, true);
    return constraints.unknowns.vertices;
  }
  double detail_error(const Positions& positions) const {
    const auto weights = laplacian_weights(topology_, mesh_.positions, LaplacianWeights::uniform);
    return lapwing::detail_error(free_vertices(), topology_, weights, mesh_.positions, positions);
  }
  double stretch(const Positions& positions) const {
    return edge_stretch(region_.roi, topology_, mesh_.positions, positions);
  }

 private:
  Mesh mesh_;
  Topology topology_;
  EditRegion region_;
};

inline SettledEdit rippled_cylinder_edit() {
  Mesh mesh = rippled_cylinder();
  EditRegion region = ends_of_cylinder(mesh);
  return {std::move(mesh), std::move(region)};
}

inline SettledEdit bumpy_tube_edit() {
  Mesh mesh = bumpy_tube();
  EditRegion region = foot_and_head(mesh);
  return {std::move(mesh), std::move(region)};
}

/// All that is held, on two handles and no belt.
inline SettledEdit free_tube_edit() {
  Mesh mesh = bumpy_tube();
  EditRegion region = foot_and_head(mesh);
  region.handles.push_back(std::move(region.belt));
  region.belt.clear();
  return {std::move(mesh), std::move(region)};
}

}  // namespace lapwing::test
