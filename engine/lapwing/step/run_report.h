#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/coating/coat_report.h"
#include "lapwing/deform/deform.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/step/peel_step.h"
#include "lapwing/transplant/transplant.h"

namespace lapwing {

/// What one step of a recipe did.
struct StepReport {
  std::string op;
  std::size_t roi = 0;  ///< vertices
  std::size_t free = 0;
  std::size_t belt = 0;
  std::vector<std::size_t> handles;  ///< vertices of each
  StageTimings timings;              ///< of all parts together
  std::optional<DeformReport> deform = {};
  std::optional<CoatReport> coat = {};  ///< of a coat or mix step
  std::optional<TransplantReport> transplant = {};
  std::optional<PeelReport> peel = {};
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
  std::vector<std::string> notes;     ///< the steps': what they did that no key says
  StageTimings timings;               ///< of the run as a whole: read, check, write
  std::vector<StepReport> steps;
  std::size_t peak_memory_bytes = 0;
};

}  // namespace lapwing
