#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/coating/coat_report.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/transplant/transplant.h"

namespace lapwing {

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
  StageTimings timings;               ///< of the run as a whole: read, check, write
  std::vector<StepReport> steps;
  std::size_t peak_memory_bytes = 0;
};

/// The report as JSON, indented, keys in a fixed order. Numbers that are not finite become null.
std::string to_json(const RunReport& report);

/// The stages of the run and of each step with their milliseconds, as lines for a terminal.
std::string format_stages(const RunReport& report);

}  // namespace lapwing
