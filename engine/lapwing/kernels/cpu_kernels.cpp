#include "lapwing/kernels/cpu_kernels.h"

#include <numeric>

#include "lapwing/kernels/cpu_ring_rotations.h"

namespace lapwing {
namespace {

class CpuSurface final : public DeformedSurface {
 public:
  explicit CpuSurface(const SurfaceInput& input)
      : rest_(input.rest.begin(), input.rest.end()),
        triangles_(input.topology.triangles),
        vertex_triangles_(input.topology.vertex_triangles),
        moving_(input.moving.begin(), input.moving.end()),
        affected_(with_ring_neighbours(moving_, input.topology.rings)),
        columns_(input.columns),
        basis_(input.basis.begin(), input.basis.end()),
        positions_(rest_),
        normals_(rest_.size(), Eigen::Vector3d::Zero()) {
    std::vector<Index> all(rest_.size());
    std::iota(all.begin(), all.end(), 0U);
    vertex_normals(positions_, triangles_, vertex_triangles_, all, normals_);
  }

  void set_basis(std::span<const double> basis) override {
    basis_.assign(basis.begin(), basis.end());
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
  void blend(std::span<const double> parameters) override {
    blend_response(rest_, moving_, basis_, parameters, positions_);
    vertex_normals(positions_, triangles_, vertex_triangles_, affected_, normals_);
  }
  void place(std::span<const Eigen::Vector3d> positions) override {
    for (const Index v : moving_) positions_[v] = positions[v];
    vertex_normals(positions_, triangles_, vertex_triangles_, affected_, normals_);
  }
  Positions positions() const override { return positions_; }
  std::vector<Eigen::Vector3d> normals() const override { return normals_; }

 private:
  Positions rest_;
  std::vector<Triangle> triangles_;
  Adjacency vertex_triangles_;
  std::vector<Index> moving_;
  std::vector<Index> affected_;
  std::size_t columns_;
  std::vector<double> basis_;
  Positions positions_;
  std::vector<Eigen::Vector3d> normals_;
};

}  // namespace

CpuKernels::CpuKernels() {
  device_.name = "CPU";
  device_.type = "cpu";
}

std::unique_ptr<RingRotations> CpuKernels::make_ring_rotations(const RegionRings& rings,
                                                               RingMotion motion) {
  return std::make_unique<CpuRingRotations>(rings, motion);
}

std::unique_ptr<DeformedSurface> CpuKernels::make_surface(const SurfaceInput& input) {
  return std::make_unique<CpuSurface>(input);
}

}  // namespace lapwing
