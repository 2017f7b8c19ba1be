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
  std::vector<double> from;  ///< direction to the eye, instead of a named view
  std::string up = "y";
  std::string background = "gradient";
  bool orthographic = false;
  bool wireframe = false;
  bool flat = false;
  double feature_angle_degrees = kFeatureAngleDegrees;

  void add_to(CLI::App& command);
  /// Returns the request. Throws CLI::ValidationError for an invalid size or direction.
  PictureRequest request() const;
};

// --color accepts these values in addition to those of pose_colors().
inline const std::string kFileColor = "file";    ///< the colours of the mesh's file
inline const std::string kPlainColor = "plain";  ///< clay

/// Values of --color that compare a pose with its rest pose: displacement, rotation, detail (of
/// uniform Laplacians) and stretch.
const std::vector<std::string>& pose_colors();

/// Colours `paint`, of the triangles of `mesh`, with the colours of its file at `path`, if there
/// are any. Returns what could not be read, and the remedy.
std::vector<std::string> color_by_file(const Mesh& mesh, const std::filesystem::path& path,
                                       SurfacePaint& paint, RenderOptions& options);

/// Colours `paint` by the difference between `mesh` and its vertices at `rest`. `measure` is one of
/// `pose_colors()`; range and legend are set to match. The range begins at 0 and excludes outliers.
/// Vertices whose rings did not move have no colour. Seams that are closed in both poses are
/// treated as joined.
void color_by(const std::string& measure, const Mesh& mesh, std::span<const Eigen::Vector3d> rest,
              SurfacePaint& paint, RenderOptions& options);

}  // namespace lapwing::cli
