#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/coating/layered_coat.h"
#include "lapwing/deform/deform.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/transplant/transplant.h"
#include "lapwing/wrap/wrap.h"

namespace lapwing {

struct PeelReport {
  double mean_coating = 0.0;  ///< as in Peeled
  double largest_coating = 0.0;
};

struct WrapStepReport : WrapReport {
  double scan_diagonal = 0.0;
  std::string trouble;           ///< why_failed
  /// Number of triangles that intersect others in the result, but not in the template. Not set if
  /// too many triangles overlap.
  std::optional<std::size_t> self_intersecting = {};
  std::vector<float> distances;  ///< as in Wrapped
};

struct StepReport {
  std::string op;
  std::size_t roi = 0;  ///< number of vertices
  std::size_t free = 0;
  std::size_t belt = 0;
  std::vector<std::size_t> handles;  ///< number of vertices of each handle
  StageTimings timings;              ///< summed over substeps
  std::optional<DeformReport> deform = {};
  std::optional<CoatReport> coat = {};  ///< report of a coat or mix step
  std::optional<TransplantReport> transplant = {};
  std::optional<PeelReport> peel = {};
  std::optional<WrapStepReport> wrap = {};
  VertexMeasures vertices;  ///< values per vertex of the ROI; empty unless requested
};

/// Report of a run: device, mesh, steps, and the time of each stage.
struct RunReport {
  DeviceInfo device;
  std::string mesh;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t triangles = 0;
  std::size_t components = 0;
  Bounds bounds;                      ///< of the mesh without isolated vertices
  std::vector<std::string> warnings;  ///< from the mesh check, the steps and the writers
  std::vector<std::string> notes;     ///< from steps: actions that no key requests
  StageTimings timings;               ///< stages of the whole run: read, check, write
  std::vector<StepReport> steps;
  std::size_t peak_memory_bytes = 0;
};

/// Returns the report as indented JSON, with keys in a fixed order. Numbers that are not finite
/// become null.
std::string to_json(const RunReport& report);

/// Returns the stages of the run and of each step with their milliseconds, as lines for a terminal.
std::string format_stages(const RunReport& report);

}  // namespace lapwing
