#pragma once

#include "lapwing/kernels/kernels.h"

namespace lapwing {

/// The kernels on the CPU, in double precision, on all threads: what the device is tested against,
/// and what runs with `--device cpu` or where there is no Vulkan.
class CpuKernels final : public Kernels {
 public:
  CpuKernels();
  const DeviceInfo& device() const override { return device_; }
  void assemble_rsi(const RingProblem& problem, std::span<double> blocks) override;
  void assemble_tangent(const EnergyProblem& problem, std::span<double> blocks) override;
  void sample_laplacians(const RingProblem& problem,
                         std::span<Eigen::Vector3d> laplacians) override;
  void sample_mapped_laplacians(const MappedRings& rings, MappedSampling sampling,
                                std::span<const Eigen::Vector3d> source,
                                std::span<Eigen::Vector3d> laplacians) override;
  void rotate_frames(const MappedRings& rings, const FramedSurface& source,
                     const FramedSurface& target, std::span<Eigen::Matrix3d> transforms) override;
  std::unique_ptr<RingRotations> make_ring_rotations(const RegionRings& rings) override;
  std::unique_ptr<DeformedSurface> make_surface(const SurfaceInput& input) override;

 private:
  DeviceInfo device_;
};

/// CPU twin of the kernel blend_response: current[moving[m]] = rest + sum_k parameters[k] basis[k].
/// Shapes as in SurfaceInput. A column with parameter 0 adds nothing.
void blend_response(std::span<const Eigen::Vector3d> rest, std::span<const Index> moving,
                    std::span<const double> basis, std::span<const double> parameters,
                    std::span<Eigen::Vector3d> current);

/// CPU twin of the kernel vertex_normals: unit area-weighted normals of the vertices `which`; zero
/// where no triangle around has area.
void vertex_normals(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> triangles,
                    const Adjacency& vertex_triangles, std::span<const Index> which,
                    std::span<Eigen::Vector3d> normals);

/// The same, to the bit, in two steps that take each triangle once: twice the area of the triangles
/// `which` along their normals, and from those of all triangles the normals of the vertices
/// `which`.
void triangle_areas(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> triangles,
                    std::span<const Index> which, std::span<Eigen::Vector3d> areas);
void vertex_normals(std::span<const Eigen::Vector3d> areas, const Adjacency& vertex_triangles,
                    std::span<const Index> which, std::span<Eigen::Vector3d> normals);

}  // namespace lapwing
