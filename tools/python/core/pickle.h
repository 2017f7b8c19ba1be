#pragma once

#include <pybind11/pybind11.h>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing::python {

namespace py = pybind11;

/// Returns the bytes of numbers, for a pickle.
template <class Number>
py::bytes pack(const std::vector<Number>& numbers) {
  return py::bytes(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

/// Reverses `pack`. Throws InputError if the length does not fit.
template <class Number>
void unpack(const py::handle& packed, std::vector<Number>& numbers) {
  const auto bytes = packed.cast<std::string>();
  if (bytes.size() % sizeof(Number) != 0) throw InputError("the pickle is damaged; make it again");
  numbers.resize(bytes.size() / sizeof(Number));
  bytes.copy(reinterpret_cast<char*>(numbers.data()), bytes.size());
}

/// Returns the positions, polygons and attributes of a mesh for a pickle, without the file that it
/// was read from.
py::tuple pack(const Mesh& mesh);
/// Reverses `pack`. Throws InputError if the data do not fit together.
Mesh unpack_mesh(const py::tuple& packed);

/// Adds `copy` and `deepcopy` to a class that cannot change: both return the same object.
template <class Class>
void add_copies(Class& of) {
  of.def("__copy__", [](const py::object& self) { return self; });
  of.def("__deepcopy__", [](const py::object& self, const py::dict&) { return self; });
}

}  // namespace lapwing::python
