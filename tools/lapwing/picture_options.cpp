#include "picture_options.h"

#include <charconv>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

namespace lapwing::cli {
namespace {

void parse_size(const std::string& text, RenderOptions& options) {
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, options.width);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, options.height);
    if (height.ec == std::errc() && height.ptr == end) return;
  }
  throw CLI::ValidationError("--size", "expected WIDTHxHEIGHT, as in 1280x960, got " + text);
}

}  // namespace

void PictureOptions::add_to(CLI::App& command) {
  const std::string group = "Picture";
  command.add_option("--size", size, "WIDTHxHEIGHT in pixels")->group(group)->capture_default_str();
  auto* named = command.add_option("--view", view, "where the picture is taken from");
  named->check(CLI::IsMember({"three-quarter", "front", "back", "left", "right", "top", "bottom"}))
      ->group(group)
      ->capture_default_str();
  command.add_option("--from", from, "direction to the eye: X,Y,Z")
      ->delimiter(',')
      ->expected(3)
      ->excludes(named)
      ->group(group);
  command.add_option("--up", up, "the mesh's upward axis")
      ->check(CLI::IsMember({"y", "z"}))
      ->group(group)
      ->capture_default_str();
  command.add_option("--background", background)
      ->check(CLI::IsMember({"gradient", "white", "transparent"}))
      ->group(group)
      ->capture_default_str();
  command.add_flag("--orthographic", orthographic, "parallel projection")->group(group);
  command.add_flag("--wireframe", wireframe, "draw polygon edges")->group(group);
  command.add_flag("--flat", flat, "one normal per triangle")->group(group);
}

RenderOptions PictureOptions::render_options() const {
  RenderOptions options;
  parse_size(size, options);
  options.background = background == "white"         ? Background::white
                       : background == "transparent" ? Background::transparent
                                                     : Background::gradient;
  options.style.wireframe = wireframe;
  options.style.flat = flat;
  return options;
}

UpAxis PictureOptions::up_axis() const {
  return up == "z" ? UpAxis::z : UpAxis::y;
}

ViewAxes PictureOptions::axes() const {
  ViewAxes axes = view_axes(view_named(view), up_axis());
  if (!from.empty()) {
    axes.toward_eye = Eigen::Vector3d(from[0], from[1], from[2]);
    if (axes.toward_eye.cross(axes.up).norm() <= 1e-6 * axes.toward_eye.norm()) {
      throw CLI::ValidationError("--from",
                                 "the direction must not be 0 or along the upward axis; "
                                 "use --view top or bottom for that");
    }
  }
  return axes;
}

Framing PictureOptions::framing(bool with_legend) const {
  Framing framing;
  framing.orthographic = orthographic;
  const RenderOptions options = render_options();
  if (with_legend) framing.legend = legend_share(options.width, options.height);
  return framing;
}

Camera PictureOptions::camera(std::span<const Eigen::Vector3d> points, bool with_legend) const {
  return fit(points, axes(), render_options().aspect(), framing(with_legend));
}

Turntable PictureOptions::turntable(std::span<const Eigen::Vector3d> points,
                                    bool with_legend) const {
  return {points, axes(), up_axis(), render_options().aspect(), framing(with_legend)};
}

}  // namespace lapwing::cli
