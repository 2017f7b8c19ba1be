#pragma once

#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/run/run_report.h"

namespace lapwing::python {

/// The result of an edit for Python. The arrays of the Python class are computed on each access.
struct Result {
  Result() = default;
  /// `rest` contains the position of each vertex of `mesh` before the edit. `region` is the region
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
