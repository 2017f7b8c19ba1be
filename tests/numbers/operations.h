#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing::test {

/// Scales and moves a mesh: x -> scale x + offset.
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
  /// Maps positions of the placed mesh back to the plain one.
  Positions back(Positions positions) const {
    for (Eigen::Vector3d& p : positions) p = (p - offset) / scale;
    return positions;
  }
};

/// An operation with a request for any mesh: the region lies around the middle of the mesh, and
/// lengths are relative to its size. The result on a placed mesh should be the placed result on the
/// plain mesh.
struct Operation {
  std::string name;
  /// Returns the result on the placed mesh, mapped back. Regions are chosen on the plain mesh, so
  /// that they do not depend on the placement.
  std::function<Mesh(const Mesh& plain, const Placement& placement)> run;
};

/// Returns deform, peel, remesh, parameterize, coat, mix and transplant. The result of parameterize
/// has the texture coordinates as positions.
std::vector<Operation> all_operations();

/// Largest difference between the two results, relative to the diagonal of the plain mesh. It is
/// below the tolerance of settling, a ten-thousandth of an edge: on needles, rounding decides where
/// within that tolerance the minimizer stops.
inline constexpr double kAgreement = 5e-6;

/// The result of an operation, or the reason why it failed.
struct Outcome {
  Mesh mesh;
  std::string refusal;  ///< empty if there is a mesh
};

Outcome outcome_of(const Operation& operation, const Mesh& plain, const Placement& placement);

/// If rounding decides between two edges that remeshing may split, collapse or flip, the results
/// have different triangles. The surfaces then differ by at most kSameSurface, relative to the
/// diagonal, and the numbers of vertices by at most kSameCount, relative to the expected one.
inline constexpr double kSameSurface = 2e-2;
inline constexpr double kSameCount = 0.1;

/// Returns whether the results agree in one of these two ways.
bool agrees(const Mesh& result, const Mesh& expected, double diagonal);

}  // namespace lapwing::test
