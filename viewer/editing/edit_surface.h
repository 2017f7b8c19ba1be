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

/// Where the surface that is drawn comes from.
enum class SurfaceSource {
  still,    ///< positions that are known: at rest, or settled
  preview,  ///< a drag by the preview's response, whoever holds it
  exact,    ///< a drag by the exact response
};

/// The surface of an edit in device memory: still, or as a drag moves it there. The device must be
/// done with what was drawn when it changes.
class EditSurface {
 public:
  /// A mesh that shares the faces of `mesh` must outlive it.
  EditSurface(std::shared_ptr<gpu::Context> context, const Mesh& mesh);

  /// Puts the surface where `positions` says: uploads the vertices that are not there.
  void place(std::span<const Eigen::Vector3d> positions);

  /// From the next drag on: begins where `pose` is, null for the rest shape, until another pose or
  /// `place`.
  void drag_from(std::shared_ptr<const DragState> pose) { pose_ = std::move(pose); }
  const std::shared_ptr<const DragState>& pose() const { return pose_; }

  /// Lets the surface follow the handles' motions from its pose on, by the exact response as soon
  /// as it is ready, until then by the preview. False, and nothing changes, while neither is.
  /// Vertices are uploaded for the first time from a pose only, and only those that move.
  bool drag(const Preparation& preparation, std::span<const Eigen::Affine3d> motions);
  /// Whether `drag` would go by the same response, from the same pose, as the last time.
  bool drags_by(const Preparation& preparation) const;

  /// The drag that it shows; nothing where it is placed.
  const std::optional<Drag>& drag_shown() const { return drag_; }

  /// What to draw.
  Surface& shown() const { return *surface_; }
  SurfaceSource source() const { return source_; }
  /// Another number whenever the surface has changed.
  std::uint64_t version() const { return version_; }

  SurfacePaint& paint() { return paint_; }
  const SurfacePaint& paint() const { return paint_; }

 private:
  void changed(SurfaceSource source);

  std::unique_ptr<Surface> surface_;
  std::shared_ptr<const DragState> pose_;
  std::optional<Drag> drag_;                  // under way
  std::shared_ptr<BlendResponse> on_device_;  // of its response
  SurfaceSource source_ = SurfaceSource::still;
  std::uint64_t version_ = 0;
  SurfacePaint paint_;
};

/// What each vertex is, for its colour: as chosen, with `live` (ascending) shown as gained by
/// `part`, or as lost if `erase` says so.
std::vector<VertexClass> shown_classes(const AppState& state, const Part& part,
                                       const VertexSet& live, bool erase);

}  // namespace lapwing::viewer
