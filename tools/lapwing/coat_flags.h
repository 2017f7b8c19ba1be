#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "lapwing/mesh/mesh.h"
#include "step_flags.h"

namespace lapwing::cli {

/// One source of a coat or mix step, by flags.
struct SourceFlags {
  std::string mesh;  ///< empty: the target itself
  std::string patch = "all";
  double detail_size = 0.0;
  std::vector<std::vector<Index>> boundary_pairs;
  std::vector<std::vector<Index>> inner_pairs;
  std::string sampling = "one_ring";
  std::optional<double> scale;
  double amplitude = 1.0;

  /// "--NAME", "--NAME-patch", and the others as "--PREFIXdetail-size" and so on.
  void add_to(CLI::App& command, const std::string& name, const std::string& prefix);
  /// Writes detail size, pairs, sampling, scale and amplitude into `json`.
  void write(nlohmann::ordered_json& json) const;
};

/// How a coat or mix step treats its target, by flags.
struct CoatedFlags {
  std::string target_patch = "all";
  double smooth_target = 0.0;
  std::string weights = "cotangent";
  std::string domain = "disk";
  std::optional<double> transition_width;
  std::string transition_profile = "smooth";
  bool no_remesh = false;

  void add_to(CLI::App& command);
  void write(nlohmann::ordered_json& step) const;
};

}  // namespace lapwing::cli
