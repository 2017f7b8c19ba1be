#pragma once

#include "lapwing/kernels/kernels.h"

namespace lapwing {

/// The kernels on the CPU, in double precision, on all threads. They are the reference in tests of
/// the device kernels, and run with `--device cpu` or without Vulkan.
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
  std::unique_ptr<RingRotations> make_ring_rotations(
      std::shared_ptr<const RegionRings> rings) override;

 private:
  DeviceInfo device_;
};

/// CPU twin of the kernel blend_response: current[v] = rest[v] + sum_k parameters[k] column_k[v]
/// for the moving vertices. `rest` and `current` have one vector per vertex of the mesh and may be
/// the same memory. Skips columns with parameter 0. Does not allocate memory.
void blend_response(std::span<const Eigen::Vector3d> rest, const ResponseColumns& columns,
                    std::span<const double> parameters, std::span<Eigen::Vector3d> current);

/// CPU twin of the kernel vertex_normals: computes area-weighted unit normals of the vertices
/// `which`. A normal is 0 if all triangles around the vertex have zero area.
void vertex_normals(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> triangles,
                    const Adjacency& vertex_triangles, std::span<const Index> which,
                    std::span<Eigen::Vector3d> normals);

}  // namespace lapwing
