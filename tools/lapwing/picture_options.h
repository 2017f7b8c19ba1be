#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "lapwing/mesh/mesh.h"
#include "lapwing/render/picture_request.h"
#include "lapwing/render/render_image.h"

namespace lapwing::cli {

/// The options of every command that draws an image.
struct PictureOptions {
  std::string size = "1280x960";
  std::string view = "three-quarter";
  std::vector<double> from;  ///< direction from the mesh to the eye; replaces `view` if not empty
  std::string up = "y";
  std::string background = "gradient";
  bool orthographic = false;
  bool wireframe = false;
  bool xray = false;
  std::string matcap = "none";
  bool flat = false;
  double feature_angle_degrees = kFeatureAngleDegrees;

  void add_to(CLI::App& command);
  /// Returns the request for the renderer. Throws CLI::ValidationError if the size or the direction
  /// is invalid.
  PictureRequest request() const;
};

// Values of --color, in addition to those of pose_colors().
inline const std::string kFileColor = "file";    ///< the colours in the mesh file
inline const std::string kPlainColor = "plain";  ///< one colour, like clay
inline const std::string kDistanceColor = "distance";  ///< the distance of a wrap from the scan

/// Returns the values of --color that compare a pose with its rest pose: displacement, rotation,
/// detail (of uniform Laplacians) and stretch.
const std::vector<std::string>& pose_colors();

/// Sets the colours of `paint` to those in the file `path`, from which `mesh` was read. `paint`
/// belongs to the triangles of `mesh`. Returns notes about colours that could not be read.
std::vector<std::string> color_by_file(const Mesh& mesh, const std::filesystem::path& path,
                                       SurfacePaint& paint, RenderOptions& options);

/// Colours `paint` by the difference between `mesh` and its rest positions `rest`. `measure` is one
/// of `pose_colors()`. Sets the range and the title of the legend in `options`. The range begins at
/// 0 and excludes outliers. Vertices whose rings did not move have no colour. Seams that are closed
/// in both poses count as joined.
void color_by(const std::string& measure, const Mesh& mesh, std::span<const Eigen::Vector3d> rest,
              SurfacePaint& paint, RenderOptions& options);

/// Colours `paint` by the distances of a wrapped template from the scan, one per vertex.
void color_by_distance(std::span<const float> distances, SurfacePaint& paint,
                       RenderOptions& options);

}  // namespace lapwing::cli
