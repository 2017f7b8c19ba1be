#include <array>
#include <cmath>
#include <vector>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "support/linear_options.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

// Equation 10 written out: T_i of every ring by the pseudo-inverse of its 7 columns, and dense
// least squares over what follows.
TEST(RsiResponse, IsThePapersSystem) {
  Mesh mesh = icosphere(1);
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    mesh.positions[i] *= 1.0 + 0.2 * std::sin(3.0 * static_cast<double>(i));
  }
  const Topology& topology = mesh.topology();
  const std::size_t n = mesh.vertex_count();
  EditRegion region;
  region.handles.resize(1);
  for (Index v = 0; v < n; ++v) {
    region.roi.push_back(v);
    if (mesh.positions[v].z() < -0.6) region.belt.push_back(v);
    if (mesh.positions[v].z() > 0.6) region.handles[0].push_back(v);
  }
  const Affine3d motion =
      Eigen::Translation3d(0.1, 0.3, 0.2) * Eigen::AngleAxisd(0.4, Vector3d(1, 2, 0).normalized());
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> right;
  for (Index i = 0; i < n; ++i) {
    std::vector<Index> ring{i};
    for (const Index j : topology.rings[i]) ring.push_back(j);
    const auto size = static_cast<Eigen::Index>(ring.size());
    Eigen::MatrixXd A(3 * size, 7);
    Vector3d delta = mesh.positions[i];
    for (Eigen::Index k = 0; k < size; ++k) {
      const Vector3d& v = mesh.positions[ring[static_cast<std::size_t>(k)]];
      if (k > 0) delta -= v / static_cast<double>(size - 1);
      A.middleRows<3>(3 * k) << v.x(), 0, v.z(), -v.y(), 1, 0, 0,  //
          v.y(), -v.z(), 0, v.x(), 0, 1, 0,                        //
          v.z(), v.y(), -v.x(), 0, 0, 0, 1;
    }
    const Eigen::MatrixXd fit = A.completeOrthogonalDecomposition().pseudoInverse();
    Eigen::Matrix<double, 3, 7> D = Eigen::Matrix<double, 3, 7>::Zero();
    D.leftCols<4>() << delta.x(), 0, delta.z(), -delta.y(),  //
        delta.y(), -delta.z(), 0, delta.x(),                 //
        delta.z(), delta.y(), -delta.x(), 0;
    const Eigen::MatrixXd T_delta = D * fit;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * n));
      for (Eigen::Index k = 0; k < size; ++k) {
        const auto at = static_cast<Eigen::Index>(3 * ring[static_cast<std::size_t>(k)]);
        row.segment<3>(at) += T_delta.block<1, 3>(axis, 3 * k).transpose();
        row[at + axis] -= k == 0 ? 1.0 : -1.0 / static_cast<double>(size - 1);
      }
      rows.push_back(row);
      right.push_back(0.0);
    }
  }
  const auto hold = [&](Index v, const Vector3d& place) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      rows.push_back(Eigen::VectorXd::Unit(static_cast<Eigen::Index>(3 * n),
                                           static_cast<Eigen::Index>(3 * v) + axis));
      right.push_back(place[axis]);
    }
  };
  for (const Index v : region.belt) hold(v, mesh.positions[v]);
  for (const Index v : region.handles[0]) hold(v, motion * mesh.positions[v]);
  Eigen::MatrixXd M(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(3 * n));
  for (std::size_t r = 0; r < rows.size(); ++r) M.row(static_cast<Eigen::Index>(r)) = rows[r];
  const Eigen::VectorXd expected = M.colPivHouseholderQr().solve(
      Eigen::Map<const Eigen::VectorXd>(right.data(), static_cast<Eigen::Index>(right.size())));

  CpuKernels kernels;
  const DeformSolver deformer(mesh.positions, topology, region, test::rsi_options(), kernels);
  const Positions result = deformer.solve(std::array{motion}).positions;
  for (std::size_t v = 0; v < n; ++v) {
    EXPECT_LT((result[v] - expected.segment<3>(static_cast<Eigen::Index>(3 * v))).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace lapwing
