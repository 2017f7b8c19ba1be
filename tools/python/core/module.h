#pragma once

#include <pybind11/pybind11.h>

// Each function adds some classes or functions to the extension module `_core`.
namespace lapwing::python {

/// Adds `run_step`, `run` and `Edit`: the operations of recipes.
void add_edits(pybind11::module_& module);

/// Adds the exception classes, which have an attribute `vertices`. Registers the translation of the
/// engine's errors to these classes.
void add_errors(pybind11::module_& module);

/// Adds `Mesh`, `read` and `write`.
void add_mesh(pybind11::module_& module);

/// Adds `peel`, `remesh`, `parameterize`, `grab_region`, `check` and `fix`.
void add_mesh_operations(pybind11::module_& module);

/// Adds `render`.
void add_render(pybind11::module_& module);

/// Adds the classes `Result` and `Certificate`.
void add_result(pybind11::module_& module);

}  // namespace lapwing::python
