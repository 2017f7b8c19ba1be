#pragma once

#include <memory>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/step/run_report.h"

namespace lapwing::python {

/// The result of an edit, as Python sees it. Its properties are computed when they are read.
struct Result {
  Mesh mesh;
  Positions rest;     ///< per vertex of `mesh`, before the edit
  EditRegion region;  ///< of the last step
  RunReport report;
};

/// Adds the classes `Result` and `Certificate`.
void add_result(pybind11::module_& module);

}  // namespace lapwing::python
