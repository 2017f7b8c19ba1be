#pragma once

#include <pybind11/pybind11.h>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing::python {

namespace py = pybind11;

/// Returns the numbers as bytes in the machine's byte order.
template <class Number>
py::bytes pack(const std::vector<Number>& numbers) {
  return py::bytes(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

/// The inverse of `pack`. Throws InputError if the length is not a multiple of a number's size.
template <class Number>
void unpack(const py::handle& packed, std::vector<Number>& numbers) {
  const auto bytes = packed.cast<std::string>();
  if (bytes.size() % sizeof(Number) != 0) throw InputError("the pickle is damaged; make it again");
  numbers.resize(bytes.size() / sizeof(Number));
  bytes.copy(reinterpret_cast<char*>(numbers.data()), bytes.size());
}

/// Packs the positions, polygons and attributes of a mesh, but not the content of its file.
py::tuple pack(const Mesh& mesh);
/// The inverse of `pack`. Throws InputError if the data are inconsistent.
Mesh unpack_mesh(const py::tuple& packed);

/// Adds `__copy__` and `__deepcopy__` to an immutable class. Both return the same object.
template <class Class>
void add_copies(Class& of) {
  of.def("__copy__", [](const py::object& self) { return self; });
  of.def("__deepcopy__", [](const py::object& self, const py::dict&) { return self; });
}

}  // namespace lapwing::python
