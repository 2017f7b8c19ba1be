#include "lapwing/kernels/cpu_kernels.h"

#include <algorithm>
#include <numeric>

#include "lapwing/base/numbers.h"
#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_ring_rotations.h"

namespace lapwing {
namespace {

// Every triangle around some vertices, ascending.
std::vector<Index> triangles_around(std::span<const Index> vertices,
                                    const Adjacency& vertex_triangles, std::size_t triangle_count) {
  std::vector<char> is_around(triangle_count, 0);
  for (const Index v : vertices) {
    for (const Index t : vertex_triangles[v]) is_around[t] = 1;
  }
  std::vector<Index> triangles;
  for (Index t = 0; t < triangle_count; ++t) {
    if (is_around[t] != 0) triangles.push_back(t);
  }
  return triangles;
}

class CpuSurface final : public DeformedSurface {
 public:
  explicit CpuSurface(const SurfaceInput& input)
      : rest_(input.rest.begin(), input.rest.end()),
        triangles_(input.topology.triangles),
        vertex_triangles_(input.topology.vertex_triangles),
        moving_(input.moving.begin(), input.moving.end()),
        affected_(with_ring_neighbours(moving_, input.topology.rings)),
        columns_(input.columns),
        positions_(rest_),
        areas_(triangles_.size()),
        normals_(rest_.size(), Eigen::Vector3d::Zero()) {
    set_basis(input.basis);
    changing_triangles_ = triangles_around(moving_, vertex_triangles_, triangles_.size());
    std::vector<Index> all(std::max(rest_.size(), triangles_.size()));
    std::iota(all.begin(), all.end(), 0U);
    triangle_areas(positions_, triangles_, std::span(all).first(triangles_.size()), areas_);
    vertex_normals(areas_, vertex_triangles_, std::span(all).first(rest_.size()), normals_);
  }

  void set_basis(std::span<const double> basis) override {
    constexpr std::size_t kNumbersPerTask = std::size_t{1} << 16U;
    basis_.resize(basis.size());
    parallel_for(basis.size(), kNumbersPerTask, [&](std::size_t begin, std::size_t end) {
      std::copy(basis.begin() + static_cast<std::ptrdiff_t>(begin),
                basis.begin() + static_cast<std::ptrdiff_t>(end),
                basis_.begin() + static_cast<std::ptrdiff_t>(begin));
    });
  }
  void set_axis_basis(std::span<const double> numbers) override {
    const std::size_t n = moving_.size();
    basis_.assign(3 * n * columns_, 0.0);
    for (std::size_t column = 0; column < columns_; ++column) {
      const std::size_t axis = column / 4 % 3;
      const double* from = numbers.data() + (4 * (column / 12) + column % 4) * n;
      double* to = basis_.data() + 3 * n * column + axis;
      for (std::size_t m = 0; m < n; ++m) to[3 * m] = from[m];
    }
  }
  void set_rest(std::span<const Eigen::Vector3d> positions) override {
    for (const Index v : moving_) rest_[v] = positions[v];
  }
  void blend(std::span<const double> parameters) override {
    blend_response(rest_, moving_, basis_, parameters, positions_);
    renew_normals();
  }
  void place(std::span<const Eigen::Vector3d> positions) override {
    for (const Index v : moving_) positions_[v] = positions[v];
    renew_normals();
  }
  Positions positions() const override { return positions_; }
  std::vector<Eigen::Vector3d> normals() const override { return normals_; }

 private:
  void renew_normals() {
    triangle_areas(positions_, triangles_, changing_triangles_, areas_);
    vertex_normals(areas_, vertex_triangles_, affected_, normals_);
  }

  Positions rest_;
  std::vector<Triangle> triangles_;
  Adjacency vertex_triangles_;
  std::vector<Index> moving_;
  std::vector<Index> affected_;            // the vertices whose normals a frame renews
  std::vector<Index> changing_triangles_;  // those with a moving corner
  std::size_t columns_;
  Numbers basis_;
  Positions positions_;
  std::vector<Eigen::Vector3d> areas_;  // per triangle, see triangle_areas
  std::vector<Eigen::Vector3d> normals_;
};

}  // namespace

CpuKernels::CpuKernels() {
  device_.name = "CPU";
  device_.type = "cpu";
}

std::unique_ptr<RingRotations> CpuKernels::make_ring_rotations(const RegionRings& rings) {
  return std::make_unique<CpuRingRotations>(rings);
}

std::unique_ptr<DeformedSurface> CpuKernels::make_surface(const SurfaceInput& input) {
  return std::make_unique<CpuSurface>(input);
}

}  // namespace lapwing
