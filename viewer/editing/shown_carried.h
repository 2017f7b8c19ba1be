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

/// What is carried along with the surface, on the screen: meshes as they are, clouds and tables as
/// points. The device must be done with what was drawn whenever it changes.
class ShownCarried {
 public:
  /// Lets all go that is on the device, or makes it there. Between them only `take` may be called.
  void release_device();
  void use_device(std::shared_ptr<gpu::Context> context);

  enum class Where {
    still,    ///< as the state knows them
    opened,   ///< as they were read
    dragged,  ///< as they are shown; one that is new where the open step finds it
  };
  /// What is carried now, and where it is shown.
  void take(const AppState& state, Where where);
  /// Puts each where a drag has it, in the order of the state.
  void place(std::span<const Positions> positions);

  /// Until the next call of another member.
  std::span<const CarriedDrawing> drawn() const { return drawn_; }
  /// Of all that is shown, one after the other.
  void append_positions(Positions& points) const;
  /// `bounds`, and all that is shown.
  Bounds united_with(Bounds bounds) const;

 private:
  struct Object {
    std::shared_ptr<const CarriedFile> opened;
    Positions positions;
    Bounds bounds;
    std::unique_ptr<Surface> surface;  // of a mesh
    std::unique_ptr<SurfacePaint> paint;
    std::unique_ptr<PointCloud> points;  // of anything else
  };

  void place(Object& object, const Positions& positions);
  void make(Object& object) const;
  void list();

  std::shared_ptr<gpu::Context> context_;
  std::vector<Object> objects_;
  std::vector<CarriedDrawing> drawn_;
};

}  // namespace lapwing::viewer
