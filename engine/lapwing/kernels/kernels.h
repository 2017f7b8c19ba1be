#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/laplacian/region_rings.h"
#include "lapwing/mesh/closest_point.h"

namespace lapwing {

/// The device that runs the kernels.
struct DeviceInfo {
  std::string name;    ///< for example "llvmpipe (LLVM 15.0.6, 256 bits)" or "CPU"
  std::string type;    ///< for example "discrete GPU", "integrated GPU", "software" or "cpu"
  std::string driver;  ///< name and version; empty for the CPU twins
  /// True if kernels run in float64; those of drawn surfaces always use float32.
  bool float64 = true;
  /// True if the energy is minimized on this device. A software device is slower at this than the
  /// CPU twins.
  bool frames = true;
  /// If this device replaces another device that failed, the name and error of that device;
  /// otherwise empty.
  std::string took_over = {};
};

/// The one-rings over which a kernel gathers. The kernel computes one result for each vertex of
/// `rows`, in this order.
struct RingProblem {
  std::span<const Eigen::Vector3d> positions;  ///< of the whole mesh
  const Adjacency& rings;                      ///< of the whole mesh
  /// One per ring entry; the weights of each row sum to 1.
  std::span<const double> weights;
  std::span<const Index> rows;
};

/// The one-rings of an energy (EnergyWeights). The weights of `rings` are EnergyWeights::laplacian.
struct EnergyProblem {
  RingProblem rings;
  std::span<const double> row_weights;  ///< om_i, per vertex of the mesh
  std::span<const double> stiffness;    ///< k_ij, per ring entry
};

/// The energy of an edit (EnergyWeights) as a function of the surface's displacement u:
///     E(u) = sum_i min over rotations R_i of om_i |L(v'_i) - R_i S_i delta_i|^2
///                                        + sum_j k_ij |(v'_i - v'_j) - R_i S_i (v_i - v_j)|^2.
class RingRotations {
 public:
  virtual ~RingRotations() = default;

  /// Sets the rest stretch S_i of each row, which is symmetric and positive definite. Before the
  /// first call, or if `stretch` is empty, all S_i are the identity.
  virtual void set_rest_stretch(std::span<const Eigen::Matrix3d> stretch) = 0;

  /// Fits the rotation R_i of every row that minimizes the energy. It is the rotation nearest to
  /// C_i S_i, where
  ///     C_i = om_i L(v'_i) delta_i' + sum_j k_ij (v'_i - v'_j) (v_i - v_j)'.
  /// `displacement` has one vector for each of RegionRings::vertices. Sets energies[i] to the term
  /// of row i in E.
  virtual void fit_rotations(std::span<const Eigen::Vector3d> displacement,
                             std::span<double> energies) = 0;

  /// Computes half of the gradient of E with respect to every unknown k, at the displacement and
  /// the rotations of the last `fit_rotations`. These rotations are optimal, so their derivatives
  /// have no effect. The gradient is gathered over rings:
  ///     g_k = sum_i L_ik om_i (L(v'_i) - T_i delta_i)
  ///         + sum_j k_kj (2 (v'_k - v'_j) - (T_k + T_j) (v_k - v_j)),     T_i = R_i S_i.
  /// If neighbour j is not a row, the term T_j is omitted and the factor 2 becomes 1. g contains x
  /// of all unknowns, then y, then z.
  virtual void energy_gradient(std::span<double> g) = 0;

  /// Returns T_i of every row for the last fit. For tests and reports.
  virtual std::vector<Eigen::Matrix3d> transforms() const = 0;
};

/// The one-rings of a target region, mapped to a source surface through a common domain (paper
/// section 5.2).
struct MappedRings {
  const RegionRings& target;
  /// The point on the source surface for each of RegionRings::vertices. If the map does not reach a
  /// vertex, its point is "nowhere" (SurfacePoint::is_nowhere): fields are 0 there, and frames
  /// ignore the vertex.
  std::span<const SurfacePoint> points;
};

/// Returns the interpolation of `values` (one per vertex) at `point`, minus `anchor`. If `anchor`
/// is close to the values, differences of two offsets are accurate even if the values are large.
/// `point` must not be nowhere.
inline Eigen::Vector3d offset_from(const Eigen::Vector3d& anchor, const SurfacePoint& point,
                                   std::span<const Eigen::Vector3d> values) {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    offset += point.weights[c] * (values[point.corners[c]] - anchor);
  }
  return offset;
}

/// How Laplacians are sampled from a source surface.
enum class MappedSampling {
  one_ring,  ///< the Laplacian of the target's ring, mapped to the source
  linear,    ///< the Laplacians of the three corners, interpolated as densities
};

/// A surface with one position and one unit normal per vertex. A normal may be 0.
struct FramedSurface {
  std::span<const Eigen::Vector3d> positions;
  std::span<const Eigen::Vector3d> normals;
};

/// A linear response of a mesh's vertices to some parameters (kernel blend_response):
///     position[v] = rest[v] + sum_k parameters[k] column_k[v]     for v in `moving`.
struct ResponseColumns {
  std::span<const Index> moving;  ///< ascending
  std::size_t count = 0;
  /// One column after the other, each with 3 |moving| numbers, starting with x, y and z of
  /// moving[0].
  std::span<const double> numbers;
  /// If true, each column displaces along one axis, and the columns for x, y and z share the same
  /// numbers: column 12 h + 4 axis + k is column 4 h + k of `numbers`. `numbers` then contains
  /// count / 3 columns with |moving| numbers each. `count` must be a multiple of 12.
  bool along_axes = false;
};

/// The core's interface to a device: the list of kernels. Each kernel has a CPU twin in double
/// precision (CpuKernels) and a Vulkan twin of the same name. Calls return when the result is
/// complete. On one device, equal inputs give bitwise identical results. All functions throw
/// GpuError if the device fails.
class Kernels {
 public:
  virtual ~Kernels() = default;

  virtual const DeviceInfo& device() const = 0;

  /// Computes the 3 x 3 blocks of the rows of M (ENERGY.md section 2):
  ///     B_ik = delta_i x_k' / S - [delta_i]x J^-1 [x_k]x - l_ik I,   l_ii = 1, l_ij = -w_ij.
  /// `blocks` has 9 numbers for each of the sum_rows (1 + |N_i|) blocks, row after row. A row
  /// contains the block of i itself, then the blocks of its ring in order, each in column-major
  /// order. A vertex without a ring has the block 0.
  virtual void assemble_rsi(const RingProblem& problem, std::span<double> blocks) = 0;

  /// Computes the 3 x 3 blocks of the rows G of the energy's tangent at rest (ENERGY.md section 5).
  /// To second order, E(u) is the energy at fixed rotations minus |G u|^2, because the rotations
  /// depend on u:
  ///     a_i(u) = sum_j k_ij [e_ij]x (u_i - u_j) + om_i [delta_i]x L(u)_i,   e_ij = v_i - v_j,
  ///     G_i = F_i^-1 a_i,   F_i F_i' = K_i = tr(C_i) I - C_i,
  ///     C_i = om_i delta_i delta_i' + sum_j k_ij e_ij e_ij'.
  /// F_i is the lower Cholesky factor. If K_i is singular (all edges are collinear), the rotation
  /// about that line is omitted. `blocks` has the layout of `assemble_rsi`.
  virtual void assemble_tangent(const EnergyProblem& problem, std::span<double> blocks) = 0;

  /// Computes delta_i = sum_j w_ij (v_i - v_j) for each row (eq. 1), which is 0 for a vertex
  /// without a ring.
  virtual void sample_laplacians(const RingProblem& problem,
                                 std::span<Eigen::Vector3d> laplacians) = 0;

  /// Samples Laplacian coordinates of a source at the rows of a target, before their rotation.
  /// `source` has one vector per source vertex. For `one_ring`, `source` is a field f, such as
  /// positions or the coat of a smooth surface, and the result of a row is f(p_i) - sum_j w_ij
  /// f(p_j). For `linear`, `source` contains Laplacians, and the result is their interpolation at
  /// p_i. Laplacians grow with the square of the ring's radius r. The caller therefore multiplies
  /// each Laplacian in `source` by 4 / r^2 of its own ring, and the result by r^2 / 4 of the
  /// target's ring. The result is 0 if p_i is nowhere, and for `one_ring` if the row has no ring.
  virtual void sample_mapped_laplacians(const MappedRings& rings, MappedSampling sampling,
                                        std::span<const Eigen::Vector3d> source,
                                        std::span<Eigen::Vector3d> laplacians) = 0;

  /// Computes T_i = s_i R_i for each row, from the source's frame at p_i to the target's frame
  /// (paper section 5.1). R_i maps the source's interpolated normal at p_i to the target's normal.
  /// In the tangent plane, it maps the edges of the mapped ring to those of the target's ring in
  /// the least-squares sense. s_i is the ratio of the edge lengths, or 1 if all points of the
  /// mapped ring coincide:
  ///     s_i = sqrt(sum_j |target edge|^2 / sum_j |mapped edge|^2).
  /// `source` is indexed by source vertices, `target` by RegionRings::vertices; both should be the
  /// low-frequency surfaces. If the edges determine no turn, R_i is the smallest rotation that maps
  /// the normal. If a normal is 0, R_i is the best rotation of the unprojected edges, or the
  /// identity if there are no edges. If p_i is nowhere, T_i is the identity.
  virtual void rotate_frames(const MappedRings& rings, const FramedSurface& source,
                             const FramedSurface& target,
                             std::span<Eigen::Matrix3d> transforms) = 0;

  /// Returns the ring rotations of a region, before the first fit.
  virtual std::unique_ptr<RingRotations> make_ring_rotations(
      std::shared_ptr<const RegionRings> rings) = 0;
};

/// Returns M for `problem.rows`, assembled on the device. Runs one kernel and one copy.
BlockRows assemble_rsi_rows(Kernels& kernels, const RingProblem& problem);

/// Returns the index of the first block of each row in the output of `assemble_rsi`, followed by
/// the total number of blocks.
std::vector<std::size_t> rsi_block_starts(const RingProblem& problem);

}  // namespace lapwing
