#include "picture_options.h"

#include <algorithm>
#include <charconv>

#include <CLI/CLI.hpp>

#include "lapwing/mesh/seams.h"
#include "lapwing/render/mip_levels.h"
#include "lapwing/render/pose_measure.h"

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

std::vector<float> measured(PoseMeasure measure, const Mesh& mesh,
                            std::span<const Eigen::Vector3d> rest) {
  const JoinedSurface joined = joined_surface(mesh);
  if (joined.empty() || !joined.is_closed_at(rest)) {
    return measure_pose(measure, mesh.topology(), rest, mesh.positions);
  }
  std::vector<float> values =
      measure_pose(measure, joined.surface.topology(), rest, mesh.positions);
  for (const Index v : joined.followers) values[v] = values[joined.leaders[v]];
  return values;
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
  command.add_flag("--xray", xray, "draw a transparent surface with its edges")->group(group);
  command.add_option("--matcap", matcap, "shade the surface as this material, without lights")
      ->check(CLI::IsMember({"none", "clay", "metal", "pearl"}))
      ->group(group)
      ->capture_default_str();
  command.add_flag("--flat", flat, "one normal per triangle")->group(group);
  command
      .add_option("--feature-angle", feature_angle_degrees,
                  "edges whose faces meet at more than this angle look hard, in degrees")
      ->check(CLI::Range(0.0, 180.0))
      ->group(group)
      ->capture_default_str();
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
  request.xray = xray;
  request.matcap = matcap_named(matcap);
  request.flat = flat;
  request.feature_angle_degrees = feature_angle_degrees;
  if (!request.can_look()) {
    throw CLI::ValidationError("--from",
                               "the direction must not be 0 or along the upward axis; "
                               "use --view top or bottom for that");
  }
  return request;
}

const std::vector<std::string>& pose_colors() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const PoseMeasure measure : all_pose_measures()) all.emplace_back(name_of(measure));
    return all;
  }();
  return names;
}

std::vector<std::string> color_by_file(const Mesh& mesh, const std::filesystem::path& path,
                                       SurfacePaint& paint, RenderOptions& options) {
  FilePaint file(read_file_colors(mesh, path));
  paint.set_file_colors(mesh, mesh, file);
  options.style.file_colors = true;
  return std::move(file.colors.notes);
}

void color_by(const std::string& measure, const Mesh& mesh, std::span<const Eigen::Vector3d> rest,
              SurfacePaint& paint, RenderOptions& options) {
  const auto all = all_pose_measures();
  const PoseMeasure wanted =
      *std::find_if(all.begin(), all.end(), [&](PoseMeasure m) { return name_of(m) == measure; });
  const std::vector<float> values = measured(wanted, mesh, rest);
  paint.set_scalars(values);
  options.style.color = SurfaceColor::scalar;
  options.style.range = range_without_outliers(values);
  options.legend_title = legend_title(wanted);
}

void color_by_distance(std::span<const float> distances, SurfacePaint& paint,
                       RenderOptions& options) {
  paint.set_scalars(distances);
  options.style.color = SurfaceColor::scalar;
  options.style.range = range_without_outliers(distances);
  options.legend_title = "distance from the scan";
}

}  // namespace lapwing::cli
