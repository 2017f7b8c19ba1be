#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/coating/correspondence.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/kernels/kernels.h"

namespace lapwing {

/// How one source came to the target of a coat or mix step.
struct CoatSourceReport {
  std::size_t vertices = 0;        ///< of the source patch
  std::vector<VertexPair> pins;    ///< the boundary pairs, given or chosen
  std::size_t flipped_source = 0;  ///< triangles that a map turned over or flattened
  std::size_t flipped_target = 0;
  int warp_steps = 0;  ///< to meet the inner pairs
  int constrained_steps = 0;
  double mean_scale = 1.0;  ///< of the coating on the target over that on the source
};

/// What a coat or mix step did.
struct CoatReport {
  std::vector<CoatSourceReport> sources;      ///< one; two of a mix
  std::size_t vertices_before_remeshing = 0;  ///< of the target patch; 0 where it was fine enough
  double transition_width = 0.0;
  double relative_residual = 0.0;
  double largest_displacement = 0.0;
  Index largest_displacement_vertex = kNoIndex;
};

/// What a transplant step did. Lengths are on the mesh that the part was put on.
struct TransplantReport {
  std::size_t part_vertices = 0;
  std::size_t host_loop = 0;  ///< vertices
  std::size_t part_loop = 0;
  std::size_t welded = 0;  ///< pairs of them that became one
  std::size_t strip_triangles = 0;
  std::size_t remeshed_vertices = 0;  ///< of the transition afterwards; 0 where it was even enough
  bool turned = false;                ///< the part was inside out
  Eigen::Matrix<double, 3, 4> place = Eigen::Matrix<double, 3, 4>::Zero();  ///< from its file
  double transition_width = 0.0;
  double padding = 0.0;
  double belt = 0.0;
  std::size_t flipped = 0;  ///< triangles that the maps over the square turned over
  double relative_residual = 0.0;
  double last_change = 0.0;           ///< of the last pass, in mean edge lengths
  double largest_displacement = 0.0;  ///< from where the part was placed
  Index largest_displacement_vertex = kNoIndex;
};

/// What one step of a recipe did.
struct StepReport {
  std::string op;
  std::size_t roi = 0;  ///< vertices
  std::size_t free = 0;
  std::size_t belt = 0;
  std::vector<std::size_t> handles;  ///< vertices of each
  std::string solver;
  double turn_degrees = 0.0;  ///< the largest turn of a handle, as written: 260 is 260
  /// How far the surface came out wound about the same axis (`wound_degrees`).
  std::optional<double> wound_degrees = {};
  std::size_t commits = 1;  ///< parts it was carried out in, each the rest shape of the next
  StageTimings timings;     ///< of all parts together
  /// Of all parts as one, from the surface that the step began with to the one that it ended with;
  /// residual and settling are the worst of the parts, the iterations those of all.
  Certificate certificate;
  /// Of a coat or mix step, whose certificate says nothing.
  std::optional<CoatReport> coat = {};
  std::optional<TransplantReport> transplant = {};  ///< likewise
  VertexMeasures vertices;  ///< of the ROI, where the run was asked for them; empty otherwise
};

/// What running a recipe did, on what, and how long each stage took.
struct RunReport {
  DeviceInfo device;
  std::string mesh;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t triangles = 0;
  std::size_t components = 0;
  Bounds bounds;
  std::vector<std::string> warnings;  ///< the mesh doctor's, the steps', and those of writing
  StageTimings timings;               ///< of the run as a whole: read, topology, check, write
  std::vector<StepReport> steps;
  std::size_t peak_memory_bytes = 0;
};

/// The report as JSON, indented, keys in a fixed order. Numbers that are not finite become null.
std::string to_json(const RunReport& report);

/// The stages of the run and of each step with their milliseconds, as lines for a terminal.
std::string format_stages(const RunReport& report);

}  // namespace lapwing
