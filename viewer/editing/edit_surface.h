#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lapwing/render/surface_paint.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "lapwing/vulkan/vulkan_surface.h"
#include "state/command.h"
#include "tools/preparation.h"

namespace lapwing::viewer {

/// Where the surface that is drawn comes from.
enum class SurfaceSource {
  still,    ///< positions that are known: at rest, or settled
  preview,  ///< a drag by the preview's response, whoever holds it
  exact,    ///< a drag by the exact response
};

/// The surface of an edit in device memory: still, or as a drag has blended it there. Drawing reads
/// the buffers that the drag wrote. The device must be done with what was drawn when it changes.
class EditSurface {
 public:
  EditSurface(const Mesh& mesh, VulkanKernels& kernels);

  /// Puts the surface where `positions` says: one upload.
  void place(std::span<const Eigen::Vector3d> positions);

  /// From the next drag on: begins where `pose` is, null for the rest shape, until another pose or
  /// `place`.
  void drag_from(std::shared_ptr<const SettledPose> pose) { pose_ = std::move(pose); }
  const std::shared_ptr<const SettledPose>& pose() const { return pose_; }

  /// Lets the surface follow the handles' motions from its pose on, by the exact response if the
  /// worker leaves it free, else by the preview. False, and nothing changes, while neither is
  /// ready. No vertex is uploaded but for the first time from a pose.
  bool drag(const Preparation& preparation, std::span<const Eigen::Affine3d> motions);

  /// What to draw. Valid until the next call of `place` or `drag`.
  VulkanSurface& shown() const { return *shown_; }
  SurfaceSource source() const { return source_; }
  /// Another number whenever the surface has changed.
  std::uint64_t version() const { return version_; }

  SurfacePaint& paint() { return paint_; }
  const SurfacePaint& paint() const { return paint_; }

 private:
  // What drags, and from where. What is drawn must live even if the worker lets go of it.
  template <typename Response>
  struct Dragged {
    std::shared_ptr<Response> response;
    std::shared_ptr<const SettledPose> pose;
  };

  void show(DeformedSurface& surface, SurfaceSource source);
  template <typename Response>
  void drag(std::shared_ptr<Response> response, std::span<const Eigen::Affine3d> motions,
            SurfaceSource source, Dragged<Response>& dragged);

  std::unique_ptr<DeformedSurface> still_;
  std::shared_ptr<const SettledPose> pose_;
  Dragged<DragPreview> preview_;
  Dragged<Deformer> exact_;
  VulkanSurface* shown_ = nullptr;
  SurfaceSource source_ = SurfaceSource::still;
  std::uint64_t version_ = 0;
  SurfacePaint paint_;
};

/// What each vertex is, for its colour: as chosen, with `live` (ascending) shown as gained by
/// `part`, or as lost if `erase` says so.
std::vector<VertexClass> shown_classes(const AppState& state, const Part& part,
                                       const VertexSet& live, bool erase);

}  // namespace lapwing::viewer
