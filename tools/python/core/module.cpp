#include "module.h"

PYBIND11_MODULE(_core, module) {
  module.doc() = "Implementation of the package lapwing; call that instead.";
  module.attr("__version__") = LAPWING_VERSION;
  lapwing::python::add_errors(module);
  lapwing::python::add_mesh(module);
  lapwing::python::add_result(module);
  lapwing::python::add_edits(module);
  lapwing::python::add_mesh_operations(module);
  lapwing::python::add_render(module);
}
