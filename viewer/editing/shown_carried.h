#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lapwing/render/point_cloud.h"
#include "lapwing/render/renderer.h"
#include "lapwing/render/surface.h"
#include "lapwing/render/surface_paint.h"
#include "state/app_state.h"

namespace lapwing::viewer {

/// The carried objects on the screen: meshes as surfaces, clouds and tables as points. When they
/// change, the device must have finished drawing them.
class ShownCarried {
 public:
  /// Release everything on the device, or make it there. In between only `take` may be called.
  void release_device();
  void use_device(std::shared_ptr<gpu::Context> context);

  enum class Where {
    still,    ///< at their places in the state
    opened,   ///< as they were read
    dragged,  ///< where they are shown; new ones where the open step finds them
  };
  /// Sets the objects to show, and where.
  void take(const AppState& state, Where where);
  /// Moves each object to its place in a drag, in the order of the state.
  void place(std::span<const Positions> positions);

  /// Valid until the next call of another member.
  std::span<const CarriedDrawing> drawn() const { return drawn_; }
  /// Appends the positions of all objects that are shown.
  void append_positions(Positions& points) const;
  /// Returns the union of `bounds` and the bounds of all objects that are shown.
  Bounds united_with(Bounds bounds) const;

 private:
  struct Object {
    std::shared_ptr<const AttachmentFile> opened;
    Positions positions;
    Bounds bounds;
    std::unique_ptr<Surface> surface;  // for a mesh
    std::unique_ptr<SurfacePaint> paint;
    std::unique_ptr<PointCloud> points;  // for anything else
  };

  static Positions shown_positions(const Object& object);
  void place(Object& object, const Positions& positions);
  void make(Object& object) const;
  void list();

  std::shared_ptr<gpu::Context> context_;
  std::vector<Object> objects_;
  std::vector<CarriedDrawing> drawn_;
};

}  // namespace lapwing::viewer
