#pragma once

#include <optional>
#include <span>

#include "lapwing/render/render_image.h"
#include "lapwing/render/turntable.h"

namespace lapwing {

/// A picture of a mesh as a person asks for it: its size, from where, and how it is drawn.
struct PictureRequest {
  std::uint32_t width = 1280;  ///< in pixels
  std::uint32_t height = 960;  ///< in pixels
  View view = View::three_quarter;
  std::optional<Eigen::Vector3d> from;  ///< direction to the eye, in place of the view
  UpAxis up = UpAxis::y;
  Background background = Background::gradient;
  bool orthographic = false;
  bool wireframe = false;
  bool flat = false;  ///< one normal per triangle

  /// Whether `from` has a direction that is not along the upward axis.
  bool can_look() const;
  RenderOptions options() const;
  /// Frames all of `points`, beside a legend where there is one.
  Camera camera(std::span<const Eigen::Vector3d> points, bool with_legend) const;
  /// The same from all around, beginning there.
  Turntable turntable(std::span<const Eigen::Vector3d> points, bool with_legend) const;

 private:
  ViewAxes axes() const;
  Framing framing(bool with_legend) const;
};

}  // namespace lapwing
