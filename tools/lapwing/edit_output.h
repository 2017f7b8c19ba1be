#pragma once

#include <filesystem>
#include <string>

#include <CLI/App.hpp>

#include "lapwing/run/run_recipe.h"
#include "lapwing/vulkan/open_device.h"
#include "picture_options.h"
#include "progress_display.h"

namespace lapwing::cli {

/// Options and output of `run` and of the step commands.
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
  std::string sandbox;  ///< the only folder that the recipe may use; empty: any
  PictureOptions picture;

  void add_to(CLI::App& command);
  /// Runs `recipe` and writes the requested files, and the recipe itself to `recipe_path` unless
  /// that is empty. Writes all of them or none, except that if no device can draw the pictures, the
  /// others are written with exit code 5. Prints progress, stages and certificate. `recipe_file` is
  /// the file of the recipe, if there is one.
  void run(const Recipe& recipe, const std::filesystem::path& recipe_file,
           const std::filesystem::path& recipe_path) const;

 private:
  // Checks before the run that the target can hold the vertex motion.
  void require_place_for_motion(const std::filesystem::path& target) const;
  void require_places(const Recipe& recipe, const std::filesystem::path& target,
                      const std::filesystem::path& recipe_file,
                      const std::filesystem::path& recipe_path) const;
  // PNG files; empty if not requested.
  struct Pictures {
    std::string before;
    std::string after;
    std::vector<std::string> notes;
  };
  Pictures draw(const RunResult& result, const std::filesystem::path& mesh_file,
                const std::shared_ptr<gpu::Context>& context) const;
  // Returns why the pictures could not be drawn, or an empty string.
  std::string add_pictures(const RunResult& result, const std::filesystem::path& mesh_file,
                           const Device& device, FileReplacements& files) const;
};

}  // namespace lapwing::cli
