#pragma once

#include <pybind11/pybind11.h>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing::python {

namespace py = pybind11;

/// Converts the numbers to bytes in the byte order of the machine.
template <class Number>
py::bytes pack(const std::vector<Number>& numbers) {
  return py::bytes(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

/// Converts bytes to numbers, the inverse of `pack`. Throws InputError if the number of bytes is
/// not a multiple of `sizeof(Number)`.
template <class Number>
void unpack(const py::handle& packed, std::vector<Number>& numbers) {
  const auto bytes = packed.cast<std::string>();
  if (bytes.size() % sizeof(Number) != 0) throw InputError("the pickle is damaged; make it again");
  numbers.resize(bytes.size() / sizeof(Number));
  bytes.copy(reinterpret_cast<char*>(numbers.data()), bytes.size());
}

/// Packs the positions, polygons and attributes of a mesh, but not the contents of its file.
py::tuple pack(const Mesh& mesh);
/// Returns the mesh that `pack` has packed. Throws InputError if the data are inconsistent.
Mesh unpack_mesh(const py::tuple& packed);

/// Adds `__copy__` and `__deepcopy__` to an immutable class. Both return the same object.
template <class Class>
void add_copies(Class& of) {
  of.def("__copy__", [](const py::object& self) { return self; });
  of.def("__deepcopy__", [](const py::object& self, const py::dict&) { return self; });
}

}  // namespace lapwing::python
