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
  std::vector<double> from;  ///< direction to the eye, in place of a named view
  std::string up = "y";
  std::string background = "gradient";
  bool orthographic = false;
  bool wireframe = false;
  bool flat = false;

  void add_to(CLI::App& command);
  /// What they say. Throws CLI::ValidationError for a size or direction that is none.
  PictureRequest request() const;
};

}  // namespace lapwing::cli
