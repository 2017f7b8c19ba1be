#pragma once

#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/run/run_report.h"

namespace lapwing::python {

/// The result of an edit, as Python sees it. Arrays are computed when they are read.
struct Result {
  Result() = default;
  /// `rest` are the positions before the edit, per vertex of `mesh`; `region` is that of the last
  /// step.
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
