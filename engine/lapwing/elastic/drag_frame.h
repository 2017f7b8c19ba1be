#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lapwing/elastic/embedding_loops.h"
#include "lapwing/kernels/kernels.h"

namespace lapwing {

/// The coefficients of one step of Chebyshev's iteration:
///     u_next = u + momentum (u - u_last) - step D^-1 g,     D = diagonal of the n x n matrix.
struct Sweep {
  float step;
  float momentum;
};

/// Number of sweeps in a frame. Eight sweeps are worth one to two iterations with the n x n factor.
inline constexpr std::size_t kSweepsPerFrame = 8;

/// The part of a drag that does not change between its frames. In a frame, the region's vertices
/// follow the vertices of a coarse surface (CoarseEmbedding). Then sweeps of Chebyshev's iteration
/// with a diagonal preconditioner reduce the energy of the fine surface: they fit the rotations of
/// the rings, gather the gradient, and step. Sweeps need no factor and no result of the last frame
/// on the CPU, so a device computes frames in a single submission.
struct DragFrameProblem {
  std::shared_ptr<const RegionRings> rings;
  /// Vertices of the mesh: RegionRings::vertices, then the handles' other vertices. All lists below
  /// that are "per vertex" have this order.
  std::vector<Index> vertices;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> rest;  ///< per vertex, relative to `origin`
  /// Per vertex. The weights are multiples of 1 / kWeightUnits; all are 0 if the vertex follows no
  /// coarse vertex.
  std::vector<EmbeddedVertex> embedded;
  std::size_t node_count = 0;  ///< number of coarse vertices
  /// Per vertex: its entry in DragFrameInput::prescribed, or kNoIndex. Vertices with an entry below
  /// `exact_count` lie exactly there.
  std::vector<Index> prescribed_entries;
  std::size_t exact_count = 0;
  /// Per entry: the stiffness W with which a vertex is held at its prescribed displacement; 0 for
  /// vertices that lie exactly there.
  std::vector<double> stiffness;
  std::vector<double> inverse_diagonal;  ///< per unknown; 0 if the unknown only follows
  std::array<Sweep, kSweepsPerFrame> sweeps{};

  /// Weights of a vertex sum to this many units.
  static constexpr std::uint32_t kWeightUnits = 65535;
  /// Coarse surfaces with more vertices do not fit into the format of the shaders.
  static constexpr std::size_t kMostNodes = 65536;

  /// Sets `inverse_diagonal` of the unknowns for which `moves` is not 0, and `sweeps`. Needs
  /// `rings`, `prescribed_entries` and `stiffness`. Estimates the largest eigenvalue of D^-1 N by
  /// power iteration, where N is the n x n matrix. Takes linear time.
  void set_sweeps(std::span<const char> moves);
};

/// What changes from frame to frame.
struct DragFrameInput {
  /// Per coarse vertex: its motion since the last frame, in coordinates relative to
  /// DragFrameProblem::origin.
  std::vector<RowsOfMotion> motions;
  std::vector<Eigen::Vector3d> prescribed;  ///< displacements; see prescribed_entries
};

/// Rounds the weights of a vertex to multiples of 1 / kWeightUnits without changing their sum.
EmbeddedVertex with_rounded_weights(const EmbeddedVertex& embedded);

/// Computes drag frames on the CPU in double precision: the twin of VulkanDragFrame, that is, of
/// the kernels prolongate, fit_rotations, energy_gradient and smooth.
class CpuDragFrame {
 public:
  explicit CpuDragFrame(std::shared_ptr<const DragFrameProblem> problem);

  /// Sets the displacements from which the next frame starts, one per vertex.
  void begin(std::vector<Eigen::Vector3d> displacement);
  void step(const DragFrameInput& input);
  const std::vector<Eigen::Vector3d>& displacement() const { return displacement_; }

 private:
  void prolongate(const DragFrameInput& input);
  void smooth(const Sweep& sweep, const DragFrameInput& input);

  std::shared_ptr<const DragFrameProblem> problem_;
  std::unique_ptr<RingRotations> rotations_;
  std::vector<Eigen::Vector3d> displacement_;
  std::vector<Eigen::Vector3d> last_;  ///< before the last sweep
  std::vector<double> gradient_;
  std::vector<double> energies_;
};

}  // namespace lapwing
