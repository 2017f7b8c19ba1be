#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "lapwing/deform/coarse_drag.h"
#include "lapwing/deform/deformer.h"
#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/handle_shares.h"
#include "lapwing/deform/made_aside.h"
#include "lapwing/deform/pose_tangent.h"
#include "lapwing/deform/rest_stretch.h"

namespace lapwing {

/// What handles ask of the surface.
struct AskedOfSurface {
  HandleMotions motions;           ///< of free handles with the rotations known so far
  std::vector<double> parameters;  ///< of those
  RestStretch stretch;
  std::vector<FreeHandle> free_handles;
  /// Per vertex of the mesh. The memory is the Deformer's, which uses it again.
  std::vector<Eigen::Vector3d>* wanted = nullptr;

  SettleTarget target() const { return {*wanted, stretch.of_vertices, {}, free_handles}; }
};

/// What a Deformer holds. Its solves are in deformer.cpp, its drags, which go by response columns,
/// in deformer_drag.cpp.
struct Deformer::State {
  std::shared_ptr<const EditSystem> system;
  StageTimings timings;
  Kernels* kernels = nullptr;
  std::unique_ptr<PoseTangent> tangent;  ///< null without settling, as the next one
  std::unique_ptr<Settler> settler;
  mutable std::unique_ptr<HandleShares> shares;  ///< null until asked for: `held_shares`
  std::shared_ptr<const EnergyWeights> weights;  ///< whose Laplacians certificates measure
  std::shared_ptr<const DragResponse> response;
  std::atomic<bool> has_response = false;      ///< `response` does not change from then on
  std::shared_ptr<const DragResponse> latest;  ///< asked for last
  std::string why_not_exact;

  // Fields over the mesh that frames write again and again, so that none of them takes a time that
  // is that of the mesh: what handles ask for, now and of the pose before; what pulls; and a
  // displacement that no pose has any more.
  mutable std::array<std::vector<Eigen::Vector3d>, 2> asked_fields;
  std::vector<Eigen::Vector3d> pull;
  mutable Positions spare;

  // Of followed drags.
  std::unique_ptr<CoarseDrag> coarse;  ///< null until it is there, and where the region needs none
  std::uint64_t last_frame = 0;        ///< SettledPose::frame
  bool coarse_is_there = false;        ///< where the last frame left the surface
  bool lacks_time = false;             ///< whether a frame of this drag has not settled in its time
  int coarse_moves_at_rest = 0;        ///< since the handles moved last
  double smoothing_ms = 0.0;           ///< what the fine level takes at least
  double ending_ms = 0.0;              ///< what a frame takes after both levels
  MadeAside<std::unique_ptr<CoarseDrag>> coarse_aside;  // last: it uses the system

  bool hold_response(const Progress& progress, StageTimings& stages);
  void make_settler(Kernels& on);
  bool has_shares() const;
  const HandleShares& held_shares() const;
  bool has_scale_forces() const;
  Numbers forces_of_scales(std::span<const double> q) const;
  Numbers forces_of(std::span<const double> q) const;
  bool has_columns_for(std::span<const double> q) const;
  Positions unwritten() const;
  Positions still() const;
  Positions moved_as(const Positions& displacement) const;
  Positions displacement_by(std::span<const double> q) const;
  RestStretch asked_stretch(std::span<const Eigen::Affine3d> motions) const;
  AskedOfSurface asked_of(HandleMotions motions, std::vector<Eigen::Vector3d>& wanted) const;
  FreeHandle free_handle(std::size_t handle, const Eigen::Affine3d& map) const;
  void take_rotations(std::span<const Eigen::Matrix3d> rotations, AskedOfSurface& asked) const;
  double share_of_recent(const SettledPose& pose, std::span<const double> change) const;
  Positions gone_on(const SettledPose& pose, std::span<const double> parameters) const;
  void begin_coarse();
  bool find_coarse();
  std::span<const Eigen::Vector3d> wanted_of(const SettledPose& pose);
  void take_along(const SettledPose& pose, std::span<const Eigen::Vector3d> wanted,
                  AskedOfSurface& asked, const GoOn& go_on, SettledPose& next);
  void place_held(const SettledPose& pose, std::span<const Eigen::Vector3d> wanted,
                  const AskedOfSurface& asked, std::span<Eigen::Vector3d> u) const;
  void follow_by_coarse(const SettledPose& pose, AskedOfSurface& asked, bool is_there,
                        const GoOn& go_on, SettledPose& next);
  void follow_by_coarse(const SettledPose& pose, AskedOfSurface& asked, bool is_there,
                        const Progress& progress, SettledPose& next);
  bool go_on_at_rest(const SettledPose& pose, AskedOfSurface& asked, SettledPose& next);
  bool smooth(AskedOfSurface& asked, bool at_rest, bool must, const GoOn& go_on,
              const Progress& progress, SettledPose& next);
};

/// From here on the way round counts, which a linear response does not know.
inline constexpr double kFarTurnDegrees = 90.0;

/// `turn` as an axis times an angle.
inline bool is_far(const Eigen::Vector3d& turn) {
  return turn.norm() > kFarTurnDegrees * std::numbers::pi / 180.0;
}

inline bool any_far(std::span<const Eigen::AngleAxisd> turns) {
  return std::any_of(turns.begin(), turns.end(), [](const Eigen::AngleAxisd& turn) {
    return is_far(turn.angle() * turn.axis());
  });
}

/// Whether a handle has turned too far from the last motions to these to go on from there.
inline bool any_far_since(const HandleMotions& last, const HandleMotions& now) {
  for (std::size_t h = 0; h < last.turns.size(); ++h) {
    if (now.is_free_handle(h)) continue;
    const Eigen::Vector3d turn = now.turns[h].angle() * now.turns[h].axis();
    if (is_far(turn - last.turns[h].angle() * last.turns[h].axis())) return true;
  }
  return false;
}

/// `motions`, whose free handles have the rotations that they have in `pose`.
HandleMotions turned_as(HandleMotions motions, const HandleMotions& pose, const EditSystem& system);

}  // namespace lapwing
