#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "lapwing/render/picture_request.h"

namespace lapwing::cli {

/// The options of every command that makes a picture.
struct PictureOptions {
  std::string size = "1280x960";
  std::string view = "three-quarter";
  std::vector<double> from;  ///< direction to the eye, instead of a named view
  std::string up = "y";
  std::string background = "gradient";
  bool orthographic = false;
  bool wireframe = false;
  bool flat = false;

  void add_to(CLI::App& command);
  /// Returns the request. Throws CLI::ValidationError for an invalid size or direction.
  PictureRequest request() const;
};

}  // namespace lapwing::cli
