#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/deform/deform_options.h"
#include "lapwing/deform/drag.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/deform/prepared_region.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/settle/settle.h"

namespace lapwing {

struct AskedOfSurface;
class DragPreview;
struct EditSystem;
struct RestStretch;

struct DeformResult {
  Positions positions;  ///< of the whole mesh; vertices that do not move keep their bits
  Certificate certificate;
  /// The S_i that the handles ask for (rest_stretch.h), per vertex of the mesh; empty for the
  /// identity.
  std::vector<Eigen::Matrix3d> rest_stretch = {};
  /// The motions asked for. A handle with free orientation has the rotation that was found.
  HandleMotions motions = {};
};

/// Detail-preserving deformation of a region by affine motions of its handles (paper, sections 3
/// and 4; ENERGY.md section 3). Construction prepares: for a linear response it assembles the
/// tangent of the energy over the region (or the RSI system, see LinearResponse) and factors it,
/// and a motion is one right-hand side after that; with settling it factors the n x n system, by
/// which most motions settle:
///
///     Deformer deformer(mesh.positions, topology, region, {}, kernels);
///     mesh.positions = deformer.solve(motions).positions;
///
/// A drag asks for the response of the surface to each of a handle's 12 degrees of freedom once,
/// and each frame is a product with those columns:
///
///     Drag drag(deformer.response());
///     drag.move(motions, mesh.positions);  // every frame
///
/// `topology` and `kernels` must outlive the deformer; positions are copied. Memory is dominated by
/// that factor (about 8 kB a vertex, more in large regions; with settling half of that, and the
/// whole from the first drag on, or the first motion that bends long parts) and, once asked for,
/// the response (300 bytes a vertex and handle). Where the options' memory limit does not allow for
/// the factor, a deformer that settles does without: `is_exact`.
class Deformer {
 public:
  /// Prepares. Stages reported and timed: "pattern", "order"; without settling "assemble",
  /// "analyze" (what was left of it), "normal_matrix", "factor"; with settling, whose "order" has
  /// the symbolic factorizations, too, "laplacian", "shares", "upload" (of what settling needs).
  /// Throws InputError for a region that does not fit the mesh, SolverError when a component of the
  /// region is not anchored or its exact system exceeds the memory limit and nothing settles,
  /// GpuError when the device fails, Cancelled when `progress` asks for it.
  Deformer(std::span<const Eigen::Vector3d> rest, const Topology& topology, EditRegion region,
           const DeformOptions& options, Kernels& kernels, const Progress& progress = {});

  /// The same with what `prepared` keeps of earlier preparations, which need not be done again:
  /// "constraints" comes in place of "pattern" and "order", and of "assemble", "normal_matrix" and
  /// "analyze" only what is to be done. Same bits.
  Deformer(PreparedRegion& prepared, std::span<const Eigen::Vector3d> rest, EditRegion region,
           const DeformOptions& options, Kernels& kernels, const Progress& progress = {});

  /// Prepares what `preview` has not, without settling from "assemble" on; timings include those of
  /// the preview's stages that it shares. May run on a thread of its own while `preview` is
  /// dragged, if `kernels` are not those that the preview uses (VulkanKernels may share a context).
  /// What is to be dragged settled is there soonest so: it waits for no symbolic factorization of
  /// the 3n x 3n system.
  Deformer(const DragPreview& preview, Kernels& kernels, const Progress& progress = {});
  ~Deformer();
  Deformer(Deformer&&) noexcept;
  Deformer& operator=(Deformer&&) noexcept;

  /// How the surface follows the handles linearly, which is what a Drag goes by. Scaling handles
  /// count by their mean scale, spread by handle weights, where settling takes a rest stretch.
  /// Solved for when first asked for, stage "response", which is timed, reported and cancelled
  /// there, with what construction has left of the factor; from then on it returns at once, on any
  /// thread.
  const std::shared_ptr<const DragResponse>& response(const Progress& progress = {}) const;

  /// The same for a drag that moves `handles` alone, of any number that the edit has: 12 right-hand
  /// sides each, solved for at every call. Waits for what solves on another thread.
  std::shared_ptr<const DragResponse> response_of(std::span<const std::size_t> handles,
                                                  const Progress& progress = {}) const;

  /// The result in double precision, settled if the options say so, with its certificate; stage
  /// "settle" is reported to `progress`, which can cancel it. A motion that is the identity returns
  /// the rest positions bit for bit. Throws SolverError when the certificate does not hold.
  DeformResult solve(std::span<const Eigen::Affine3d> motions, const Progress& progress = {}) const;

  /// The same for motions that tell their turns: a surface is wound the way that its handles went,
  /// as far as it can hold that. What was solved or asked for before makes no difference to the
  /// bits. A drag may have found a better order for the Hessian of a pose (`begin_to_follow`),
  /// which rounds otherwise: that makes a difference of some 1e-7 of the region. Throws InputError
  /// for a handle whose orientation is free unless the options settle with soft constraints.
  DeformResult solve(const HandleMotions& motions, const Progress& progress = {}) const;

  /// The same along a path: the surface settles at each motion of `path` in turn, from where it was
  /// before, and then at `motions`. Far motions have several minima; the path decides which one is
  /// found. Large regions follow it on their coarse surface, and settle themselves at the end.
  DeformResult solve_along(std::span<const HandleMotions> path, const HandleMotions& motions,
                           const Progress& progress = {}) const;

  /// The same from a pose of this region (`follow`, DragResponse::pose_at): the minimum that the
  /// pose leads to, so that what a drag has shown is what it ends in. From an empty pose, and
  /// without settling, the same as `solve`.
  DeformResult solve_from(const SettledPose& pose, const HandleMotions& motions,
                          const Progress& progress = {}) const;

  /// One settled frame of a drag: moves `pose` on to where the handles' motions take it. It begins
  /// where the last frames lead as far as the handles go on as they did, and goes the rest of the
  /// way by the linear response: that of `response` or `response_of`, which was asked for last, as
  /// long as the other handles rest. Where none was asked for it is a DragPreview's, which does as
  /// well where the coarse surface leads (below), and that of `response` elsewhere. Every frame is
  /// a better surface than that, and as good as `go_on` (Settler::follow) leaves time for. Where
  /// that was too little for a frame, a region of 6,500 vertices or more is taken along by one of
  /// 3,500 instead (CoarseDrag), which takes little time at any size and asks `go_on`, too, until
  /// the handles rest; then the surface itself is settled. Which frames have that surface depends
  /// on when it is made (`begin_to_follow`); after `prepare_to_follow` all do. With the same
  /// motions again it goes on, and once settled nothing moves. From
  /// an empty pose it begins where `solve` does, and so does a frame in which a handle has turned
  /// by more than 90 degrees since the last, for which the old pose tells too little. One drag at a
  /// time; another one begins with `begin_drag`. Throws InputError without settling in the options,
  /// SolverError when the result is not finite, Cancelled when `progress` asks for it, each time
  /// with `pose` as it was.
  void follow(const HandleMotions& motions, SettledPose& pose, const GoOn& go_on = {},
              const Progress& progress = {}) const;

  /// The same with turns that add up from frame to frame, as TurnTracker follows them.
  void follow(std::span<const Eigen::Affine3d> motions, SettledPose& pose, const GoOn& go_on = {},
              const Progress& progress = {}) const;

  /// Whether frames that `follow` settles are the better for `response`: smaller regions', and none
  /// where nothing settles.
  bool response_helps_to_follow() const;

  /// Begins to make what `follow` needs where frames have too little time: the coarse surface, and
  /// then the memory for the tangent of a pose, half that of the 3n x 3n factor, by which the
  /// surface settles when the handles rest. A thread of its own makes each, in a third of a second
  /// at 26,000 vertices and some seconds at a million; returns at once. Without it the first such
  /// frame of a drag begins it. Nothing for regions that settle within their frames.
  void begin_to_follow() const;

  /// The same, with the linear response that frames go by, and waits for that and for the coarse
  /// surface, so that no frame of a drag depends on how long they take to make. The first rest may
  /// wait for the tangent's memory. Throws Cancelled when `progress` asks for it.
  void prepare_to_follow(const Progress& progress = {}) const;

  /// The S_i that handles so moved ask for, as DeformResult has them; empty if no handle scales.
  /// Waits for what solves on another thread only if one does.
  std::vector<Eigen::Matrix3d> rest_stretch(std::span<const Eigen::Affine3d> motions) const;

  /// Forgets what the frames of the last drag have told.
  void begin_drag() const;

  /// Whether another one made from all this would solve to the same bits.
  bool is_of(std::span<const Eigen::Vector3d> rest, const Topology& topology,
             const EditRegion& region, const DeformOptions& options, const Kernels& kernels) const;

  /// Whether the 3n x 3n system is there, or was not needed so far. Without it (the region was too
  /// large for the memory limit) the response is a DragPreview's, and settling starts without; what
  /// it settles to is the same within its tolerance.
  bool is_exact() const;
  /// What the system would need, and may take, in words; empty where `is_exact`.
  std::string_view why_not_exact() const;

  const EditRegion& region() const;
  const StageTimings& timings() const;
  std::string_view solver_name() const;
  std::size_t unknown_count() const;  ///< vertices solved for
  std::size_t free_count() const;     ///< of those, neither handle nor belt

 private:
  struct State;
  Deformer(std::shared_ptr<const EditSystem> system, Kernels& kernels, const Progress& progress);
  void hold(const Progress& progress) const;
  void make_response(const Progress& progress) const;
  void make_columns_to_follow(const Progress& progress) const;
  std::shared_ptr<const DragResponse> columns_of(std::vector<std::size_t> handles,
                                                 const Progress& progress) const;
  void hold_for_settling() const;
  void wait_for_coarse(const Progress& progress) const;
  std::vector<Eigen::Vector3d> turned_start(const HandleMotions& motions,
                                            const RestStretch& stretch) const;
  SettledPose followed(std::span<const HandleMotions> path, const Progress& progress) const;
  void settle_to(AskedOfSurface& asked, const SettledPose* pose, std::span<Eigen::Vector3d> u,
                 SettleResult& result, const Progress& progress) const;
  DeformResult solved(const SettledPose* pose, const HandleMotions& motions,
                      const Progress& progress) const;

  std::unique_ptr<State> state_;
};

}  // namespace lapwing
