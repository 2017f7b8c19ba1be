#include "lapwing/render/picture_request.h"

#include <Eigen/Geometry>

namespace lapwing {

bool PictureRequest::can_look() const {
  if (!from) return true;
  const Eigen::Vector3d upward = view_axes(view, up).up;
  return from->cross(upward).norm() > 1e-6 * from->norm();
}

RenderOptions PictureRequest::options() const {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.background = background;
  options.style.wireframe = wireframe;
  options.style.xray = xray;
  options.style.matcap = matcap;
  options.style.flat = flat;
  return options;
}

Camera PictureRequest::camera(std::span<const Eigen::Vector3d> points, bool with_legend) const {
  return fit(points, axes(), options().aspect(), framing(with_legend));
}

Turntable PictureRequest::turntable(std::span<const Eigen::Vector3d> points,
                                    bool with_legend) const {
  return {points, axes(), up, options().aspect(), framing(with_legend)};
}

ViewAxes PictureRequest::axes() const {
  ViewAxes axes = view_axes(view, up);
  if (from) axes.toward_eye = *from;
  return axes;
}

Framing PictureRequest::framing(bool with_legend) const {
  Framing framing;
  framing.orthographic = orthographic;
  if (with_legend) framing.legend = legend_share(width, height);
  return framing;
}

}  // namespace lapwing
