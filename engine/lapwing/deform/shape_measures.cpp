#include "lapwing/deform/shape_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/parallel.h"
#include "lapwing/deform/vertex_motion.h"
#include "lapwing/laplacian/ring_fit.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kRowsPerTask = 256;

// Details are treated as rounding errors if the ratio of their root mean square to that of the edge
// lengths is less than this. A flat surface has a smaller ratio even if its file has only six
// digits or 32-bit floats. A smooth surface has a larger ratio even with a hundred million
// triangles.
constexpr double kLeastDetail = 1e-4;
constexpr double kNoDetails = std::numeric_limits<double>::quiet_NaN();
Vector3d stretched(std::span<const Matrix3d> stretch, Index i, const Vector3d& rest) {
  return stretch.empty() ? rest : Vector3d(stretch[i] * rest);
}

// Returns |length' / length - 1| of an edge, or a negative value if its length is 0.
double stretch_of(Index i, Index j, std::span<const Vector3d> rest,
                  std::span<const Vector3d> current, std::span<const Matrix3d> stretch) {
  const Vector3d edge = rest[i] - rest[j];
  const double was =
      0.5 * (stretched(stretch, i, edge).norm() + stretched(stretch, j, edge).norm());
  return was > 0.0 ? std::abs((current[i] - current[j]).norm() / was - 1.0) : -1.0;
}

// Sums over the edges of one or several rings.
struct RowStretches {
  double sum_of_squares = 0.0;
  std::size_t count = 0;
  StretchedEdge most;

  void add(const RowStretches& other) {
    sum_of_squares += other.sum_of_squares;
    count += other.count;
    if (other.most.stretch > most.stretch) most = other.most;
  }
  double root_mean_square() const {
    return count > 0 ? std::sqrt(sum_of_squares / static_cast<double>(count)) : 0.0;
  }
};

RowStretches stretches_of_row(Index i, const Topology& topology, std::span<const Vector3d> rest,
                              std::span<const Vector3d> current,
                              std::span<const Matrix3d> stretch) {
  RowStretches row;
  for (const Index j : topology.rings[i]) {
    const double change = stretch_of(i, j, rest, current, stretch);
    if (change < 0.0) continue;
    row.sum_of_squares += change * change;
    ++row.count;
    if (change > row.most.stretch) row.most = {{std::min(i, j), std::max(i, j)}, change};
  }
  return row;
}

// delta_i and L(v'_i). Computed from differences, which avoids a loss of precision far from the
// origin.
struct Laplacians {
  Vector3d was = Vector3d::Zero();
  Vector3d is = Vector3d::Zero();
  double edges = 0.0;  // mean squared length of the ring edges at rest
};
Laplacians laplacians_of(Index i, const Topology& topology, std::span<const double> weights,
                         std::span<const Vector3d> rest, std::span<const Vector3d> current) {
  const auto ring = topology.rings[i];
  const double* w = weights.data() + topology.rings.starts[i];
  Laplacians of;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    of.was += w[k] * (rest[i] - rest[ring[k]]);
    of.is += w[k] * (current[i] - current[ring[k]]);
    of.edges += (rest[i] - rest[ring[k]]).squaredNorm() / static_cast<double>(ring.size());
  }
  return of;
}

// Returns true if the details are larger than rounding errors. Both arguments are sums over the
// same rings.
bool has_details(double squares_of_details, double squares_of_edges) {
  return squares_of_details > kLeastDetail * kLeastDetail * squares_of_edges;
}

}  // namespace

double detail_error(std::span<const Index> rows, const Topology& topology,
                    std::span<const double> weights, std::span<const Vector3d> rest,
                    std::span<const Vector3d> current, std::span<const Matrix3d> stretch) {
  std::vector<Matrix3d> rotations(rest.size());
  parallel_for(rows.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (const Index i : rows.subspan(begin, end - begin)) {
      rotations[i] = stretch.empty()
                         ? fit_rotation(i, topology.rings[i], rest, current)
                         : fit_rotation(i, topology.rings[i], rest, current, stretch[i]);
    }
  });
  return detail_error(rows, topology, weights, rest, current, rotations, stretch);
}

double detail_error(std::span<const Index> rows, const Topology& topology,
                    std::span<const double> weights, std::span<const Vector3d> rest,
                    std::span<const Vector3d> current, std::span<const Matrix3d> rotations,
                    std::span<const Matrix3d> stretch) {
  struct Row {
    double off = 0.0;
    double size = 0.0;
    double edges = 0.0;
  };
  std::vector<Row> of_rows(rows.size());
  parallel_for(rows.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Index i = rows[r];
      const Laplacians L = laplacians_of(i, topology, weights, rest, current);
      const Vector3d expected = stretched(stretch, i, L.was);
      of_rows[r] = {(L.is - rotations[i] * expected).squaredNorm(), expected.squaredNorm(),
                    L.edges};
    }
  });
  Row sum;
  for (const Row& row : of_rows) {
    sum.off += row.off;
    sum.size += row.size;
    sum.edges += row.edges;
  }
  return has_details(sum.size, sum.edges) ? std::sqrt(sum.off / sum.size) : kNoDetails;
}

double edge_stretch(std::span<const Index> rows, const Topology& topology,
                    std::span<const Vector3d> rest, std::span<const Vector3d> current,
                    std::span<const Matrix3d> stretch) {
  RowStretches sum;
  CancelCheck cancel_check;
  for (const Index i : rows) {
    cancel_check();
    sum.add(stretches_of_row(i, topology, rest, current, stretch));
  }
  return sum.root_mean_square();
}

EdgeStretches edge_stretches(std::span<const Index> rows, const Topology& topology,
                             std::span<const Vector3d> rest, std::span<const Vector3d> current,
                             std::span<const Matrix3d> stretch) {
  std::vector<RowStretches> of_rows(rows.size());
  parallel_for(rows.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      of_rows[r] = stretches_of_row(rows[r], topology, rest, current, stretch);
    }
  });
  RowStretches sum;
  for (const RowStretches& row : of_rows) sum.add(row);
  return {sum.root_mean_square(), sum.most};
}

VertexMeasures measure_vertices(std::span<const Index> rows, const Topology& topology,
                                std::span<const double> weights, std::span<const Vector3d> rest,
                                std::span<const Vector3d> current) {
  VertexMeasures measures;
  measures.vertices.assign(rows.begin(), rows.end());
  for (auto* list : {&measures.rotation_degrees, &measures.detail_error, &measures.stretch}) {
    list->resize(rows.size());
  }
  measures.displacement.resize(rows.size());
  measures.rotation.resize(rows.size());
  std::vector<double> sizes(rows.size());
  std::vector<double> edges(rows.size());
  parallel_for(rows.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Index i = rows[r];
      const Laplacians L = laplacians_of(i, topology, weights, rest, current);
      const Matrix3d R = ring_rotation(i, topology.rings[i], rest, current);
      measures.displacement[r] = current[i] - rest[i];
      measures.rotation[r] = unit_quaternion(R);
      measures.rotation_degrees[r] = rotation_angle(R) * 180.0 / std::numbers::pi;
      measures.detail_error[r] = (L.is - R * L.was).norm();
      measures.stretch[r] = edge_stretch(rows.subspan(r, 1), topology, rest, current);
      sizes[r] = L.was.squaredNorm();
      edges[r] = L.edges;
    }
  });
  const double sum = std::accumulate(sizes.begin(), sizes.end(), 0.0);
  const bool measurable = has_details(sum, std::accumulate(edges.begin(), edges.end(), 0.0));
  const double size = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(rows.size(), 1)));
  for (double& error : measures.detail_error) error = measurable ? error / size : kNoDetails;
  return measures;
}

double rotation_angle(const Matrix3d& R) {
  const Vector3d twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return std::atan2(twice_sine.norm(), R.trace() - 1.0);
}

}  // namespace lapwing
