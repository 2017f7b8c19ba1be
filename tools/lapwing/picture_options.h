#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "lapwing/render/render_image.h"
#include "lapwing/render/turntable.h"

namespace lapwing::cli {

/// The options of every command that makes a picture.
struct PictureOptions {
  std::string size = "1280x960";
  std::string view = "three-quarter";
  std::vector<double> from;  ///< direction to the eye, in place of a named view
  std::string up = "y";
  std::string background = "gradient";
  bool orthographic = false;
  bool wireframe = false;
  bool flat = false;

  void add_to(CLI::App& command);
  /// Throws CLI::ValidationError for a size that is none.
  RenderOptions render_options() const;
  /// Frames all of `points`, beside a legend where there is one.
  Camera camera(std::span<const Eigen::Vector3d> points, bool with_legend) const;
  /// The same from all around, beginning there.
  Turntable turntable(std::span<const Eigen::Vector3d> points, bool with_legend) const;

 private:
  UpAxis up_axis() const;
  ViewAxes axes() const;
  Framing framing(bool with_legend) const;
};

}  // namespace lapwing::cli
