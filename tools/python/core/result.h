#pragma once

#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/run/run_report.h"

namespace lapwing::python {

/// Holds the result of an edit for Python. An array is computed when Python reads it.
struct Result {
  Result() = default;
  /// `rest` holds the positions before the edit, one per vertex of `mesh`. `region` is the region
  /// of the last step.
  Result(Mesh mesh, Positions rest, EditRegion region, RunReport report);

  Mesh mesh;
  Positions rest;
  VertexSet roi;
  VertexSet belt;
  std::vector<VertexSet> handles;
  std::optional<Certificate> certificate;
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
  std::string report_json;
};

}  // namespace lapwing::python
