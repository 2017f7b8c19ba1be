#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/deform/drag.h"
#include "lapwing/render/surface.h"
#include "lapwing/render/surface_paint.h"
#include "state/command.h"
#include "work/preparation.h"

namespace lapwing::viewer {

/// Where the positions of the drawn surface come from.
enum class SurfaceSource {
  still,    ///< known: at rest, or settled
  preview,  ///< a drag by the preview's response
  exact,    ///< a drag by the exact response
};

/// Holds the surface of an edit in device memory, and moves it during a drag. Change it only after
/// the device has finished drawing it.
class EditSurface {
 public:
  /// A mesh that shares the faces of `mesh` must outlive this object.
  EditSurface(std::shared_ptr<gpu::Context> context, const Mesh& mesh,
              double feature_angle_degrees);

  /// Moves the surface to `positions`. Uploads the vertices that change.
  void place(std::span<const Eigen::Vector3d> positions);

  /// Sets the pose from which the next drag starts. A null pose means the rest shape. `place`
  /// resets the pose to null.
  void drag_from(std::shared_ptr<const DragState> pose) { pose_ = std::move(pose); }
  const std::shared_ptr<const DragState>& pose() const { return pose_; }

  /// Moves the surface from its pose by the handles' motions. Uses the exact response once that is
  /// ready, and the preview's response until then. Returns false, without any change, if neither is
  /// ready. Uploads the positions of the moving vertices only when the response or the pose
  /// changes.
  bool drag(const Preparation& preparation, std::span<const Eigen::Affine3d> motions);
  /// Returns whether `drag` would use the same response and pose as the last time.
  bool drags_by(const Preparation& preparation) const;

  /// Returns the displayed drag. Empty after `place`.
  const std::optional<Drag>& drag_shown() const { return drag_; }

  /// The surface to draw.
  Surface& shown() const { return *surface_; }
  SurfaceSource source() const { return source_; }
  /// Returns a number that changes whenever the surface changes.
  std::uint64_t version() const { return version_; }

  SurfacePaint& paint() { return paint_; }
  const SurfacePaint& paint() const { return paint_; }

 private:
  void changed(SurfaceSource source);

  std::unique_ptr<Surface> surface_;
  std::shared_ptr<const DragState> pose_;
  std::optional<Drag> drag_;                  // under way
  std::shared_ptr<BlendResponse> on_device_;  // its response
  SurfaceSource source_ = SurfaceSource::still;
  std::uint64_t version_ = 0;
  SurfacePaint paint_;
};

/// Returns the class of each vertex, for its colour. The vertices `live` (ascending) are shown as
/// gained by `part`, or as lost if `erase`.
std::vector<VertexClass> shown_classes(const AppState& state, const Part& part,
                                       const VertexSet& live, bool erase);

/// Returns a colour for the stiffness of each vertex: softer vertices are coloured like the belt,
/// stiffer ones like a handle. `stiffness` are factors as in AppState.
std::vector<VertexClass> stiffness_classes(const AppState& state,
                                           std::span<const StiffnessSpec> stiffness);

}  // namespace lapwing::viewer
