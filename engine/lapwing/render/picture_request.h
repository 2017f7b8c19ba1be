#pragma once

#include <optional>
#include <span>

#include "lapwing/mesh/split_normals.h"
#include "lapwing/render/render_image.h"
#include "lapwing/render/turntable.h"

namespace lapwing {

/// A user's request for an image of a mesh: its size, viewpoint and style.
struct PictureRequest {
  std::uint32_t width = 1280;  ///< in pixels
  std::uint32_t height = 960;  ///< in pixels
  View view = View::three_quarter;
  std::optional<Eigen::Vector3d> from = {};  ///< direction from mesh to camera; replaces `view`
  UpAxis up = UpAxis::y;
  Background background = Background::gradient;
  bool orthographic = false;
  bool wireframe = false;
  bool xray = false;  ///< see SurfaceStyle
  Matcap matcap = Matcap::none;
  bool flat = false;                                    ///< draws each triangle with one normal
  double feature_angle_degrees = kFeatureAngleDegrees;  ///< see split_normals()

  /// Returns whether `from` is unset or is not parallel to the up axis.
  bool can_look() const;
  RenderOptions options() const;
  /// Returns a camera that shows all `points`, usually the surface_positions of a mesh. If
  /// `with_legend` is true, it reserves space for the legend.
  Camera camera(std::span<const Eigen::Vector3d> points, bool with_legend) const;
  /// Returns a turntable that starts at the requested view.
  Turntable turntable(std::span<const Eigen::Vector3d> points, bool with_legend) const;

 private:
  ViewAxes axes() const;
  Framing framing(bool with_legend) const;
};

}  // namespace lapwing
