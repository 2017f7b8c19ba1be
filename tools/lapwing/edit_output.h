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
  std::string sandbox;  ///< the folder that the recipe must not leave; empty: it may
  PictureOptions picture;

  void add_to(CLI::App& command);
  /// Runs `recipe` and writes what was asked for, and the recipe itself to `recipe_path` unless
  /// that is empty: all of it or nothing, but for pictures that no device can draw: then all the
  /// rest, and exit code 5. Prints progress, stages and certificate. `recipe_file` is where the
  /// recipe was read, if it was.
  void run(const Recipe& recipe, const std::filesystem::path& recipe_file,
           const std::filesystem::path& recipe_path) const;

 private:
  // The vertex motion is asked for before there is any.
  void require_place_for_motion(const std::filesystem::path& target) const;
  void require_places(const Recipe& recipe, const std::filesystem::path& target,
                      const std::filesystem::path& recipe_file,
                      const std::filesystem::path& recipe_path) const;
  // PNGs; empty for those that were not asked for.
  struct Pictures {
    std::string before;
    std::string after;
    std::vector<std::string> notes;
  };
  Pictures draw(const RunResult& result, const std::filesystem::path& mesh_file,
                const std::shared_ptr<gpu::Context>& context) const;
  // Empty where they were drawn; else why not.
  std::string add_pictures(const RunResult& result, const std::filesystem::path& mesh_file,
                           const Device& device, FileReplacements& files,
                           ProgressDisplay& display) const;
};

}  // namespace lapwing::cli
