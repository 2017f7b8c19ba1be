#pragma once

#include <pybind11/pybind11.h>

namespace lapwing::python {

/// Adds the exceptions to `module`, each with an attribute `vertices`, and translates the engine's
/// errors to them.
void add_errors(pybind11::module_& module);

}  // namespace lapwing::python
