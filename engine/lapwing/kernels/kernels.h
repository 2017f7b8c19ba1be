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
  std::string name;     ///< "llvmpipe (LLVM 15.0.6, 256 bits)", "CPU"
  std::string type;     ///< "discrete GPU", "integrated GPU", "software", "cpu"
  std::string driver;   ///< driver name and version; empty for the CPU twins
  bool float64 = true;  ///< whether kernels run in float64, except those of drawn surfaces
  /// Whether the energy is minimized on it. A software device is slower at this than the CPU twin.
  bool frames = true;
  /// If it took over from a device that failed: which one, and how. Empty otherwise.
  std::string took_over = {};
};

/// The one-rings that a kernel gathers over. `rows` lists the vertices that get a result, in order.
struct RingProblem {
  std::span<const Eigen::Vector3d> positions;  ///< of the whole mesh
  const Adjacency& rings;                      ///< of the whole mesh
  std::span<const double> weights;             ///< one per ring entry, rows summing to 1
  std::span<const Index> rows;
};

/// The one-rings of an energy (EnergyWeights). The weights of `rings` are its `laplacian`.
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

  /// Sets the rest stretch S_i of each row, symmetric and positive definite. It is the identity
  /// before the first call, or if `stretch` is empty.
  virtual void set_rest_stretch(std::span<const Eigen::Matrix3d> stretch) = 0;

  /// Fits R_i of every row, which minimizes the energy: the nearest rotation to C_i S_i,
  ///     C_i = om_i L(v'_i) delta_i' + sum_j k_ij (v'_i - v'_j) (v_i - v_j)'.
  /// `displacement` has one vector for each of RegionRings::vertices. Sets energies[i] to the part
  /// of row i in E.
  virtual void fit_rotations(std::span<const Eigen::Vector3d> displacement,
                             std::span<double> energies) = 0;

  /// Computes half of the gradient of E by every unknown k, at the displacement and the rotations
  /// of the last `fit_rotations`. These rotations are optimal, so their derivatives do not count. A
  /// gather over rings:
  ///     g_k = sum_i L_ik om_i (L(v'_i) - T_i delta_i)
  ///         + sum_j k_kj (2 (v'_k - v'_j) - (T_k + T_j) (v_k - v_j)),     T_i = R_i S_i.
  /// For a neighbour j that is no row, T_j is left out and 2 becomes 1. g has x of all unknowns,
  /// then y, then z.
  virtual void energy_gradient(std::span<double> g) = 0;

  /// Returns T_i of every row, as last fitted. For tests and reports.
  virtual std::vector<Eigen::Matrix3d> transforms() const = 0;
};

/// The one-rings of a target region, mapped to a source surface through a common domain (paper
/// section 5.2).
struct MappedRings {
  const RegionRings& target;
  /// The point on the source for each of RegionRings::vertices. Nowhere if the map does not reach
  /// the vertex: fields are 0 there, and frames leave it out.
  std::span<const SurfacePoint> points;
};

/// Returns `values`, one per vertex, interpolated at `point`, minus `anchor`. If `anchor` is near
/// the values, differences of such offsets keep their digits, however far from 0 these are. `point`
/// must not be nowhere.
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
  /// Column after column, 3 |moving| numbers each; x, y, z of moving[0] first.
  std::span<const double> numbers;
  /// If true, each column displaces along one axis, and x, y and z share their numbers. For each
  /// axis, column 12 h + 4 axis + k is column 4 h + k of `numbers`, which holds a third of the
  /// columns with |moving| numbers each. `count` must be a multiple of 12.
  bool along_axes = false;
};

/// The kernels, as the core sees the device. Each has a CPU twin in double precision (CpuKernels)
/// and a Vulkan twin of the same name. Calls return when the result is complete. The same input
/// gives the same bits on one device. Throws GpuError if the device fails.
class Kernels {
 public:
  virtual ~Kernels() = default;

  virtual const DeviceInfo& device() const = 0;

  /// Computes the 3 x 3 blocks of the rows of M (ENERGY.md section 2):
  ///     B_ik = delta_i x_k' / S - [delta_i]x J^-1 [x_k]x - l_ik I,   l_ii = 1, l_ij = -w_ij.
  /// `blocks` holds 9 numbers for each of sum_rows (1 + |N_i|) blocks, row after row. A row has the
  /// block of i itself, then those of its ring in order, each column-major. A vertex without ring
  /// has the block 0.
  virtual void assemble_rsi(const RingProblem& problem, std::span<double> blocks) = 0;

  /// Computes the 3 x 3 blocks of the rows G of the energy's tangent at rest (ENERGY.md section 5).
  /// To second order, E(u) is the energy at fixed rotations minus |G u|^2, because the rotations
  /// follow u:
  ///     a_i(u) = sum_j k_ij [e_ij]x (u_i - u_j) + om_i [delta_i]x L(u)_i,   e_ij = v_i - v_j,
  ///     G_i = F_i^-1 a_i,   F_i F_i' = K_i = tr(C_i) I - C_i,
  ///     C_i = om_i delta_i delta_i' + sum_j k_ij e_ij e_ij'.
  /// F_i is the lower Cholesky factor. If K_i is singular (all edges on a line), the direction in
  /// which nothing turns is left out. `blocks` has the layout of `assemble_rsi`.
  virtual void assemble_tangent(const EnergyProblem& problem, std::span<double> blocks) = 0;

  /// Computes delta_i = sum_j w_ij (v_i - v_j) for each row (eq. 1); 0 for a vertex without ring.
  virtual void sample_laplacians(const RingProblem& problem,
                                 std::span<Eigen::Vector3d> laplacians) = 0;

  /// Samples Laplacian coordinates of a source at the rows of a target, before they are rotated.
  /// `source` has one vector per source vertex. With one_ring, it is a field f, such as positions
  /// or the coat of a smooth surface, and each row gets f(p_i) - sum_j w_ij f(p_j). With linear, it
  /// has Laplacians, and each row gets the one at p_i. Laplacians grow with the square of their
  /// ring's radius r. So `source` has them as densities, times 4 / r^2, and the caller multiplies
  /// by r^2 / 4 of the target's ring. 0 for a row that lies nowhere and, with one_ring, for one
  /// without ring.
  virtual void sample_mapped_laplacians(const MappedRings& rings, MappedSampling sampling,
                                        std::span<const Eigen::Vector3d> source,
                                        std::span<Eigen::Vector3d> laplacians) = 0;

  /// Computes T_i = s_i R_i for each row, from the source's frame at p_i to the target's frame
  /// (paper section 5.1). R_i carries the source's interpolated normal at p_i to the target's. It
  /// also fits the edges of the mapped ring, projected onto the tangent plane, to those of the
  /// target's ring in the least-squares sense. s_i is the local edge-length ratio, 1 if the mapped
  /// ring has no extent:
  ///     s_i = sqrt(sum_j |target edge|^2 / sum_j |mapped edge|^2).
  /// `source` is per source vertex, `target` per RegionRings::vertices; both should be the
  /// low-frequency surfaces. If the edges determine no turn, R_i is the smallest rotation that
  /// carries the normal. If a normal is 0, R_i is the best rotation of the unprojected edges, the
  /// identity if there are none. A row that lies nowhere gets the identity.
  virtual void rotate_frames(const MappedRings& rings, const FramedSurface& source,
                             const FramedSurface& target,
                             std::span<Eigen::Matrix3d> transforms) = 0;

  /// Returns the ring rotations of a region, not fitted yet.
  virtual std::unique_ptr<RingRotations> make_ring_rotations(
      std::shared_ptr<const RegionRings> rings) = 0;
};

/// Returns M for `problem.rows`, assembled on the device. The cost is one kernel and one copy.
BlockRows assemble_rsi_rows(Kernels& kernels, const RingProblem& problem);

/// Returns the number of blocks that `assemble_rsi` writes before each row, and the total: rows + 1
/// numbers.
std::vector<std::size_t> rsi_block_starts(const RingProblem& problem);

}  // namespace lapwing
