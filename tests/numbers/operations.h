#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing::test {

/// Scales and translates a mesh: x -> scale x + offset.
struct Placement {
  std::string name;
  double scale = 1.0;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator()(const Eigen::Vector3d& x) const { return scale * x + offset; }
  Mesh operator()(Mesh mesh) const {
    mesh.source.reset();
    for (Eigen::Vector3d& p : mesh.positions) p = (*this)(p);
    return mesh;
  }
  /// Maps positions of the transformed mesh back to the original mesh.
  Positions back(Positions positions) const {
    for (Eigen::Vector3d& p : positions) p = (p - offset) / scale;
    return positions;
  }
};

/// An operation with a request that suits any mesh: the region lies around the middle of the mesh,
/// and lengths are relative to the mesh size. The operation should commute with every placement.
struct Operation {
  std::string name;
  /// Transforms the mesh by `placement`, applies the operation and maps the result back. The
  /// regions are selected on the mesh `plain`, so that they do not depend on the placement.
  std::function<Mesh(const Mesh& plain, const Placement& placement)> run;
};

/// Returns deform, peel, remesh, parameterize, coat, mix and transplant. In the result of
/// parameterize, the positions are the texture coordinates.
std::vector<Operation> all_operations();

/// The largest accepted difference between the two results, relative to the diagonal of the
/// original mesh. It allows for the tolerance of settling, 1e-4 edge lengths: on needle triangles,
/// rounding determines where within this tolerance the minimizer stops.
inline constexpr double kAgreement = 5e-6;

/// The result of an operation, or the reason why it failed.
struct Outcome {
  Mesh mesh;
  std::string refusal;  ///< error message; empty if there is a mesh
};

Outcome outcome_of(const Operation& operation, const Mesh& plain, const Placement& placement);

/// If rounding determines which of two edges remeshing splits, collapses or flips, the results have
/// different triangles. The distance between the surfaces may then be at most kSameSurface times
/// the diagonal. The number of vertices may differ from the expected number by at most the fraction
/// kSameCount.
inline constexpr double kSameSurface = 2e-2;
inline constexpr double kSameCount = 0.1;

/// Returns whether the results agree within kAgreement, or within kSameSurface and kSameCount.
bool agrees(const Mesh& result, const Mesh& expected, double diagonal);

}  // namespace lapwing::test
