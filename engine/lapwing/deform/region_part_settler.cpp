#include "lapwing/deform/region_part_settler.h"

#include <algorithm>

#include "lapwing/deform/pose_tangent.h"
#include "lapwing/deform/response_system.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr int kMostIterations = 40;

// The rows of a part: those that its unknowns are in, and those of the corners of its springs.
class PartRows {
 public:
  explicit PartRows(std::span<const char> in_roi) : may_come_(in_roi.begin(), in_roi.end()) {}

  void add(Index v) {
    if (may_come_[v] == 0) return;
    may_come_[v] = 0;
    rows_.push_back(v);
  }
  VertexSet take() {
    std::sort(rows_.begin(), rows_.end());
    return std::move(rows_);
  }

 private:
  std::vector<char> may_come_;
  VertexSet rows_;
};

std::vector<Spring> springs_on(const Unknowns& unknowns, std::span<const Spring> springs) {
  std::vector<Spring> own;
  std::copy_if(springs.begin(), springs.end(), std::back_inserter(own), [&](const Spring& spring) {
    return std::any_of(spring.corners.begin(), spring.corners.end(),
                       [&](Index v) { return unknowns.of_vertex[v] != kNoIndex; });
  });
  return own;
}

}  // namespace

RegionPartSettler::RegionPartSettler(const EditSystem& edit)
    : edit_(edit), in_roi_(edit.rest->size(), 0) {
  for (const Index v : edit.region.roi) in_roi_[v] = 1;
}

void RegionPartSettler::settle_part(std::span<const Index> vertices, const SettleTarget& target,
                                    std::span<Vector3d> u, const GoOn& go_on,
                                    const Progress& progress) {
  const LaplacianSystem& whole = edit_.systems->laplacian();
  const Topology& topology = edit_.topology;
  const Unknowns unknowns(std::vector<Index>(vertices.begin(), vertices.end()), u.size());
  const std::vector<Spring> springs = springs_on(unknowns, whole.springs());
  PartRows of_part(in_roi_);
  for (const Index v : vertices) {
    of_part.add(v);
    for (const Index j : topology.rings[v]) of_part.add(j);
  }
  for (const Spring& spring : springs) {
    for (const Index v : spring.corners) of_part.add(v);
  }
  const VertexSet rows = of_part.take();

  std::vector<double> W;
  std::vector<Vector3d> wanted(u.begin(), u.end());
  for (const Index v : vertices) {
    W.push_back(whole.constraints().W[whole.constraints().unknowns.of_vertex[v]]);
    if (W.back() > 0.0) wanted[v] = target.wanted[v];
  }
  const SystemPattern pattern(topology, rows, unknowns);
  LaplacianSystem part(topology, rows, unknowns, pattern);
  part.assemble(whole.shared_weights(), springs);
  part.analyze();
  part.factor(W);
  part.make_rings(*edit_.rest);

  CpuKernels kernels;
  PoseTangent tangent(topology, rows, pattern, part, edit_.options,
                      [&] { return tangent_rows(topology, rows, part, *edit_.rest, kernels); });
  SettleOptions options = *edit_.options.settle;
  options.max_iterations = std::min(options.max_iterations, kMostIterations);
  Settler(kernels, part, options, &tangent)
      .settle_small({wanted, target.rest_stretch}, u, go_on, progress);
}

}  // namespace lapwing
