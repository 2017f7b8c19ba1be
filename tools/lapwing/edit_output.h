#pragma once

#include <filesystem>
#include <string>

#include <CLI/App.hpp>

#include "lapwing/session/run_recipe.h"
#include "lapwing/vulkan/open_device.h"
#include "picture_options.h"
#include "progress_display.h"

namespace lapwing::cli {

/// What `run` and `deform` do with a recipe, and where the results go.
struct EditOutput {
  std::string save;
  std::string report;
  bool report_vertices = false;
  bool vertex_motion = false;
  std::string render;
  std::string render_before;
  std::string color = "regions";
  std::string device = "auto";
  std::string frames = "auto";
  bool strict = false;
  bool quiet = false;
  PictureOptions picture;

  void add_to(CLI::App& command);
  /// Runs `recipe` and writes what was asked for; prints progress, stages and certificate.
  void run(const Recipe& recipe) const;

 private:
  // The vertex motion is asked for before there is any.
  void require_place_for_motion(const std::filesystem::path& target) const;
  void draw(const RunResult& result, const std::filesystem::path& mesh_file, const Device& device,
            ProgressDisplay& display) const;
};

}  // namespace lapwing::cli
