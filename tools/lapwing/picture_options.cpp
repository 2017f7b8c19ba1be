#include "picture_options.h"

#include <charconv>

#include <CLI/CLI.hpp>

namespace lapwing::cli {
namespace {

void parse_size(const std::string& text, PictureRequest& request) {
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, request.width);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, request.height);
    if (height.ec == std::errc() && height.ptr == end) return;
  }
  throw CLI::ValidationError("--size", "expected WIDTHxHEIGHT, such as 1280x960, got " + text);
}

}  // namespace

void PictureOptions::add_to(CLI::App& command) {
  const std::string group = "Picture";
  command.add_option("--size", size, "WIDTHxHEIGHT in pixels")->group(group)->capture_default_str();
  auto* named = command.add_option("--view", view, "the side from which the picture is taken");
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

PictureRequest PictureOptions::request() const {
  PictureRequest request;
  parse_size(size, request);
  request.view = view_named(view);
  if (!from.empty()) request.from = Eigen::Vector3d(from[0], from[1], from[2]);
  request.up = up == "z" ? UpAxis::z : UpAxis::y;
  request.background = background == "white"         ? Background::white
                       : background == "transparent" ? Background::transparent
                                                     : Background::gradient;
  request.orthographic = orthographic;
  request.wireframe = wireframe;
  request.flat = flat;
  if (!request.can_look()) {
    throw CLI::ValidationError("--from",
                               "the direction must not be 0 or along the upward axis; "
                               "use --view top or bottom for that");
  }
  return request;
}

}  // namespace lapwing::cli
