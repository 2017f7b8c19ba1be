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
  std::string sandbox;  ///< if not empty, the only folder whose files the recipe may use
  PictureOptions picture;

  /// Adds the flags, and returns the option for `save`, whose flag is `save_flag`.
  CLI::Option* add_to(CLI::App& command, const std::string& save_flag = "--save");
  /// Runs `recipe` and writes the requested files. Also writes the recipe to `recipe_path` unless
  /// this path is empty. Writes either all files or none, with one exception: if no device can draw
  /// the images, writes all other files and exits with code 5. Prints progress, stages and
  /// certificate. `recipe_file` is the file from which the recipe was read, or empty.
  void run(const Recipe& recipe, const std::filesystem::path& recipe_file,
           const std::filesystem::path& recipe_path) const;

 private:
  // Throws CLI::ValidationError if the format of `target` cannot store the vertex motion.
  void require_place_for_motion(const std::filesystem::path& target) const;
  void require_places(const Recipe& recipe, const std::filesystem::path& target,
                      const std::filesystem::path& recipe_file,
                      const std::filesystem::path& recipe_path) const;
  // The contents of PNG files. An image that was not requested is empty.
  struct Pictures {
    std::string before;
    std::string after;
    std::vector<std::string> notes;
  };
  Pictures draw(const RunResult& result, const std::filesystem::path& mesh_file,
                const std::shared_ptr<gpu::Context>& context) const;
  // Draws the images and adds them to `files`. Returns an error message, or an empty string.
  std::string add_pictures(const RunResult& result, const std::filesystem::path& mesh_file,
                           const Device& device, FileReplacements& files) const;
};

}  // namespace lapwing::cli
