#include "window/scene_contents.h"

#include "lapwing/render/point_cloud.h"
#include "lapwing/render/surface.h"
#include "lapwing/render/surface_paint.h"

namespace lapwing::viewer {

SceneContents::Seen SceneContents::seen(const SurfaceScene& scene) {
  Seen all;
  // Without a surface only the background shows, whatever the camera.
  if (scene.surface == nullptr) return all;
  all.surface = scene.surface->revision();
  all.paint = scene.paint->revision();
  all.camera = scene.camera;
  all.style = scene.style;
  all.style.sides = Sides::both;
  return all;
}

void SceneContents::take(const Scene& scene) {
  main_ = seen(scene);
  carried_.clear();
  for (const CarriedDrawing& drawing : scene.carried) {
    carried_.push_back(drawing.surface != nullptr ? drawing.surface->revision() : 0);
    carried_.push_back(drawing.paint != nullptr ? drawing.paint->revision() : 0);
    carried_.push_back(drawing.points != nullptr ? drawing.points->revision() : 0);
  }
  beside_.reset();
  corner_.setZero();
  size_.setZero();
  if (scene.beside) {
    beside_ = seen(*scene.beside);
    corner_ = scene.beside->corner;
    size_ = scene.beside->size;
  }
  background_ = scene.background;
}

bool SceneContents::differs_in_view_alone(const SceneContents& other) const {
  SceneContents here = *this;
  here.main_.camera = other.main_.camera;
  if (here.beside_ && other.beside_) here.beside_->camera = other.beside_->camera;
  return here == other && *this != other;
}

}  // namespace lapwing::viewer
