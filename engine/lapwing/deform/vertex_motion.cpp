#include "lapwing/deform/vertex_motion.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "lapwing/base/parallel.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/laplacian/ring_fit.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr std::size_t kVerticesPerTask = 256;

}  // namespace

VertexMotion vertex_motion(std::span<const Vector3d> rest, std::span<const Vector3d> current,
                           const Topology& topology) {
  std::vector<Index> all(rest.size());
  std::iota(all.begin(), all.end(), Index{0});
  return vertex_motion(all, rest, current, topology);
}

VertexMotion vertex_motion(std::span<const Index> rows, std::span<const Vector3d> rest,
                           std::span<const Vector3d> current, const Topology& topology) {
  VertexMotion motion;
  motion.displacements.assign(rest.size(), Vector3d::Zero());
  motion.rotations.assign(rest.size(), Quaterniond::Identity());
  motion.stretch.assign(rest.size(), 0.0);
  parallel_for(rows.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Index i = rows[r];
      motion.displacements[i] = current[i] - rest[i];
      motion.rotations[i] = unit_quaternion(ring_rotation(i, topology.rings[i], rest, current));
      motion.stretch[i] = edge_stretch(rows.subspan(r, 1), topology, rest, current);
    }
  });
  return motion;
}

Quaterniond unit_quaternion(const Matrix3d& R) {
  Quaterniond q(R);
  q.normalize();
  const std::array ordered{q.w(), q.x(), q.y(), q.z()};
  const auto* first =
      std::find_if(ordered.begin(), ordered.end(), [](double part) { return part != 0.0; });
  if (first != ordered.end() && *first < 0.0) q.coeffs() = -q.coeffs();
  return q;
}

Matrix3d ring_rotation(Index i, std::span<const Index> ring, std::span<const Vector3d> rest,
                       std::span<const Vector3d> current) {
  const auto is_still = [&](Index v) { return rest[v] == current[v]; };
  if (is_still(i) && std::all_of(ring.begin(), ring.end(), is_still)) return Matrix3d::Identity();
  return fit_rotation(i, ring, rest, current);
}

}  // namespace lapwing
