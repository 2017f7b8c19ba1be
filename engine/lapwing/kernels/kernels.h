#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lapwing/laplacian/region_rings.h"
#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/mesh/surface_point.h"

namespace lapwing {

/// What runs the kernels.
struct DeviceInfo {
  std::string name;     ///< "llvmpipe (LLVM 15.0.6, 256 bits)", "CPU"
  std::string type;     ///< "discrete GPU", "integrated GPU", "software", "cpu"
  std::string driver;   ///< driver name and version; empty for the CPU twins
  bool float64 = true;  ///< whether all but surfaces runs in float64
  /// Whether settling runs on it. The processor does it sooner than a device that is the processor
  /// in disguise.
  bool frames = true;
  /// Of a device that took over from one that failed: which that was, and how; empty otherwise.
  std::string took_over = {};
};

/// The one-rings a kernel gathers over. `rows` names the vertices that get a result, in order.
struct RingProblem {
  std::span<const Eigen::Vector3d> positions;  ///< of the whole mesh
  const Adjacency& rings;                      ///< of the whole mesh
  std::span<const double> weights;             ///< one per ring entry, rows summing to 1
  std::span<const Index> rows;
};

/// The one-rings of an energy (EnergyWeights), whose `laplacian` are the weights of `rings`.
struct EnergyProblem {
  RingProblem rings;
  std::span<const double> row_weights;  ///< om_i, per vertex of the mesh
  std::span<const double> stiffness;    ///< k_ij, per ring entry
};

/// The energy of an edit (EnergyWeights) as its rings see it, in the position u of the surface:
///     E(u) = sum_i min over rotations R_i of om_i |L(v'_i) - R_i S_i delta_i|^2
///                                        + sum_j k_ij |(v'_i - v'_j) - R_i S_i (v_i - v_j)|^2.
class RingRotations {
 public:
  virtual ~RingRotations() = default;

  /// The rest stretch S_i of each row, symmetric and positive definite. The identity until it is
  /// called, and again if `stretch` is empty.
  virtual void set_rest_stretch(std::span<const Eigen::Matrix3d> stretch) = 0;

  /// R_i of every row: the nearest rotation to C_i S_i, C_i = om_i L(v'_i) delta_i' + sum_j k_ij
  /// (v'_i - v'_j) (v_i - v_j)', which makes the energy least. `displacement` has one vector for
  /// each of RegionRings::vertices. `energies` gets what row i adds to E.
  virtual void fit_rotations(std::span<const Eigen::Vector3d> displacement,
                             std::span<double> energies) = 0;

  /// Half of the gradient of E by every unknown k, at the displacement of the last `fit_rotations`,
  /// with the rotations found there (which are the best, so it is that of E): a gather over rings,
  ///     g_k = sum_i L_ik om_i (L(v'_i) - T_i delta_i)
  ///         + sum_j k_kj (2 (v'_k - v'_j) - (T_k + T_j) (v_k - v_j)),     T_i = R_i S_i,
  /// T_j left out, and one 1 of the 2, for a neighbour that is no row. x of all unknowns, then y,
  /// then z.
  virtual void energy_gradient(std::span<double> g) = 0;

  /// T_i of every row, as last fitted. For tests and reports.
  virtual std::vector<Eigen::Matrix3d> transforms() const = 0;
};

/// The one-rings of a target region, laid onto a source surface through a common domain (paper
/// section 5.2).
struct MappedRings {
  const RegionRings& target;
  /// Per RegionRings::vertices: where it comes to lie on the source. Nowhere for a vertex that the
  /// map does not reach; fields are 0 there, and frames leave it out.
  std::span<const SurfacePoint> points;
};

/// How Laplacians are taken from a source surface.
enum class MappedSampling {
  one_ring,  ///< the target's ring is laid onto the source and its Laplacian taken there
  linear,    ///< those of the three corners, as densities, are interpolated
};

/// A surface with its unit normals, one of each per vertex; a normal may be 0.
struct FramedSurface {
  std::span<const Eigen::Vector3d> positions;
  std::span<const Eigen::Vector3d> normals;
};

/// The kernels, as the core sees the device. Each has a CPU twin in double precision (CpuKernels)
/// and a Vulkan twin of the same name. Calls return when the result is there. Same input, same
/// bits, on one device. Throws GpuError when the device fails.
class Kernels {
 public:
  virtual ~Kernels() = default;

  virtual const DeviceInfo& device() const = 0;

  /// The 3 x 3 blocks of the rows of M (ENERGY.md section 2):
  ///     B_ik = delta_i x_k' / S - [delta_i]x J^-1 [x_k]x - l_ik I,   l_ii = 1, l_ij = -w_ij.
  /// Row after row; in a row the block of i itself, then those of its ring in order; each block
  /// column after column. `blocks` holds 9 numbers for each of sum_rows (1 + |N_i|) blocks. A
  /// vertex without ring has the block 0.
  virtual void assemble_rsi(const RingProblem& problem, std::span<double> blocks) = 0;

  /// The 3 x 3 blocks of the rows G of the energy's tangent at rest (ENERGY.md section 5): to
  /// second order E(u) = sum of the energy with rotations held - |G u|^2, where the rotations
  /// follow u:
  ///     a_i(u) = sum_j k_ij [e_ij]x (u_i - u_j) + om_i [delta_i]x L(u)_i,   e_ij = v_i - v_j,
  ///     G_i = F_i^-1 a_i,   F_i F_i' = K_i = tr(C_i) I - C_i,
  ///     C_i = om_i delta_i delta_i' + sum_j k_ij e_ij e_ij',
  /// F_i the lower Cholesky factor; where K_i is singular (all edges on a line) the direction in
  /// which nothing turns is left out. Layout of `blocks` as in `assemble_rsi`.
  virtual void assemble_tangent(const EnergyProblem& problem, std::span<double> blocks) = 0;

  /// delta_i = sum_j w_ij (v_i - v_j) for each row (eq. 1); 0 for a vertex without ring.
  virtual void sample_laplacians(const RingProblem& problem,
                                 std::span<Eigen::Vector3d> laplacians) = 0;

  /// Laplacian coordinates of a source at the rows of a target, before they are turned. `source`
  /// has one vector per source vertex: with one_ring a field f (positions, say, or what coats a
  /// smooth surface), of which each row gets f(p_i) - sum_j w_ij f(p_j); with linear Laplacians, of
  /// which each row gets the one at p_i. Laplacians grow with the square of their ring's radius r:
  /// `source` has these as densities, 4 / r^2 as large, and who samples takes r^2 / 4 of the
  /// target's ring. 0 for a row that lies nowhere and, with one_ring, for one without ring.
  virtual void sample_mapped_laplacians(const MappedRings& rings, MappedSampling sampling,
                                        std::span<const Eigen::Vector3d> source,
                                        std::span<Eigen::Vector3d> laplacians) = 0;

  /// T_i = s_i R_i for each row, the turn from the source's frame at p_i to the target's frame
  /// (paper section 5.1): R_i carries the source's normal at p_i, interpolated, to the target's,
  /// and the edges of the mapped ring, projected onto the tangent plane, to those of the ring, in
  /// the least-squares sense over all of them. s_i is the local edge-length ratio
  /// sqrt(sum_j |target edge|^2 / sum_j |mapped edge|^2), 1 where the mapped ring has no extent.
  /// `source` is per source vertex, `target` per RegionRings::vertices; both should be the
  /// low-frequency surfaces. Where the edges tell nothing, R_i is the smallest rotation that
  /// carries the normal; where a normal is 0, the best rotation of the unprojected edges, the
  /// identity if there are none. A row that lies nowhere gets the identity.
  virtual void rotate_frames(const MappedRings& rings, const FramedSurface& source,
                             const FramedSurface& target,
                             std::span<Eigen::Matrix3d> transforms) = 0;

  /// The rings of a region, not turned yet.
  virtual std::unique_ptr<RingRotations> make_ring_rotations(
      std::shared_ptr<const RegionRings> rings) = 0;
};

/// M for `problem.rows`, assembled on the device. The cost is one kernel and one copy.
BlockRows assemble_rsi_rows(Kernels& kernels, const RingProblem& problem);

/// Number of blocks that `assemble_rsi` writes before each row, and in all: rows + 1 numbers.
std::vector<std::size_t> rsi_block_starts(const RingProblem& problem);

}  // namespace lapwing
