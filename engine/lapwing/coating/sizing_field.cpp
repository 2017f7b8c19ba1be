#include "lapwing/coating/sizing_field.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Calls `add` for the edges of each triangle, twice for an inner edge.
template <class Add>
void for_each_edge(std::span<const Triangle> triangles, const Add& add) {
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) add(t[k], t[(k + 1) % 3]);
  }
}

// Returns whether the point is at a source vertex. This keeps the triangles of a surface that is
// coated with itself.
bool on_vertex(const SurfacePoint& point) {
  constexpr double kNearlyAll = 0.99;
  return *std::max_element(point.weights.begin(), point.weights.end()) > kNearlyAll;
}

struct Mean {
  double sum = 0.0;
  double count = 0.0;
  double value() const { return count > 0.0 ? sum / count : 0.0; }
};

std::vector<double> mean_edges(std::span<const Triangle> triangles,
                               std::span<const Vector3d> positions) {
  std::vector<Mean> means(positions.size());
  for_each_edge(triangles, [&](Index a, Index b) {
    const double length = (positions[a] - positions[b]).norm();
    for (const Index v : {a, b}) {
      means[v].sum += length;
      means[v].count += 1.0;
    }
  });
  std::vector<double> lengths;
  for (const Mean& mean : means) lengths.push_back(mean.value());
  return lengths;
}

// Returns, per vertex of the target, the ratio of lengths on the target to lengths on the source.
std::vector<double> local_ratios(const Patch& target, std::span<const Vector3d> positions,
                                 std::span<const SurfacePoint> points,
                                 std::span<const Vector3d> source) {
  std::vector<double> here(positions.size(), 0.0);
  std::vector<double> there(positions.size(), 0.0);
  for_each_edge(target.triangles, [&](Index a, Index b) {
    const double on_target = (positions[a] - positions[b]).squaredNorm();
    const double on_source =
        (points[a].of<Vector3d>(source) - points[b].of<Vector3d>(source)).squaredNorm();
    for (const Index v : {a, b}) {
      here[v] += on_target;
      there[v] += on_source;
    }
  });
  std::vector<double> ratios(positions.size(), 0.0);
  for (std::size_t v = 0; v < ratios.size(); ++v) {
    if (there[v] > 0.0) ratios[v] = std::sqrt(here[v] / there[v]);
  }
  return ratios;
}

// Averages each value with its neighbours, so that lengths change gradually.
void spread(std::span<const Triangle> triangles, std::vector<double>& values) {
  std::vector<Mean> means(values.size());
  for (std::size_t v = 0; v < values.size(); ++v) means[v] = {2.0 * values[v], 2.0};
  for_each_edge(triangles, [&](Index a, Index b) {
    means[a].sum += values[b];
    means[b].sum += values[a];
    means[a].count += 1.0;
    means[b].count += 1.0;
  });
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = means[v].value();
}

}  // namespace

SizingField::SizingField(const Coating& coating, const Patch& target,
                         std::span<const Vector3d> positions, std::span<const SurfacePoint> points)
    : triangles_(target.triangles), lengths_(mean_edges(target.triangles, positions)) {
  const auto source_edges = mean_edges(coating.patch.triangles, coating.smooth);
  const auto ratios = local_ratios(target, positions, points, coating.smooth);
  std::size_t coarse = 0;
  CancelCheck cancel_check;
  for (std::size_t v = 0; v < lengths_.size(); ++v) {
    cancel_check();
    const double fineness = on_vertex(points[v]) ? 1.0 : kFineness;
    const double wanted = fineness * ratios[v] * points[v].of<double>(source_edges);
    if (!(wanted > 0.0) || wanted >= lengths_[v]) continue;
    if (lengths_[v] > kCoarseRatio * wanted) ++coarse;
    lengths_[v] = wanted;
  }
  too_coarse_ =
      static_cast<double>(coarse) > kCoarseShare * static_cast<double>(target.vertices.size());
  if (!too_coarse_) return;
  closest_.emplace(triangles_, positions);
  constexpr int kSpreads = 3;
  for (int i = 0; i < kSpreads; ++i) spread(triangles_, lengths_);

  for (const auto& [a, b, c] : triangles_) {
    const double twice_area =
        (positions[b] - positions[a]).cross(positions[c] - positions[a]).norm();
    const double length = (lengths_[a] + lengths_[b] + lengths_[c]) / 3.0;
    // Assume equilateral triangles, two per vertex.
    if (length > 0.0) vertex_estimate_ += twice_area / (std::sqrt(3.0) * length * length);
  }
}

double SizingField::operator()(const Vector3d& point) const {
  const TrianglePoint nearest = closest_->find(0, point);
  return SurfacePoint{triangles_[nearest.triangle], nearest.weights}.of<double>(lengths_);
}

void SizingField::limit_vertices(double count) {
  if (vertex_estimate_ <= count) return;
  const double factor = std::sqrt(vertex_estimate_ / count);
  for (double& length : lengths_) length *= factor;
  vertex_estimate_ = count;
}

}  // namespace lapwing
