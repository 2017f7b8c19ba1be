#pragma once

#include <initializer_list>
#include <pybind11/numpy.h>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing::python {

namespace py = pybind11;

/// Returns the mesh of `vertices`, numbers of shape (n, 3), and `faces`, integers of shape (m, k)
/// with k >= 3, or a list of polygons. Accepts any numeric type and memory order. Throws InputError
/// if a shape or type is invalid, or if a face contains an invalid vertex.
Mesh mesh_of(const py::object& vertices, const py::object& faces);

/// Converts an array of shape (count, 3) to the positions of another pose. Throws InputError if the
/// array has another shape.
Positions positions_of(const py::object& vertices, std::size_t count);

/// Copies the vectors to an array of shape (n, 3), or the numbers to an array of shape (n).
py::array_t<double> array_of(std::span<const Eigen::Vector3d> vectors);
py::array_t<Index> array_of(std::span<const Index> numbers);
/// Returns an array of shape (m, k) if all polygons have k corners, and otherwise a list of arrays.
py::object faces_of(const Mesh& mesh);

/// Returns an iterator over two new arrays, the vertices and the faces, so that Python can unpack
/// `V, F = mesh`. The caller may change both arrays.
py::iterator arrays_of(const Mesh& mesh);

/// Makes an array, or each array of a list, read-only, and returns its argument. Use this function
/// for attributes that return a new array on each access, because values written to such an array
/// would be lost.
py::object read_only(py::object arrays);

/// Returns the value of the choice named `chosen`. If there is no such choice, throws an InputError
/// that names `place` and all choices.
template <class Value>
Value one_of(const std::string& place, const std::string& chosen,
             std::initializer_list<std::pair<const char*, Value>> choices) {
  std::string known;
  for (const auto& [name, value] : choices) {
    if (chosen == name) return value;
    known += (known.empty() ? "\"" : ", \"") + std::string(name) + "\"";
  }
  throw InputError(place + ": expected one of " + known + ", got \"" + chosen + "\"");
}

/// The motions of an array of shape (count, handles, 4, 4) or (count, handles, 3, 4). The matrices
/// are stored by rows and act on column vectors. The constructor throws an InputError that names
/// the invalid entry if the shape is different, a number is not finite, or the last row of a matrix
/// is not 0 0 0 1.
class Motions {
 public:
  Motions(const py::object& array, std::size_t handles);
  std::size_t count() const { return count_; }
  std::size_t handles() const { return handles_; }
  Eigen::Matrix<double, 3, 4> matrix(std::size_t k, std::size_t handle) const;

 private:
  std::vector<double> numbers_;
  std::size_t count_ = 0;
  std::size_t handles_ = 0;
  std::size_t rows_ = 0;
};

}  // namespace lapwing::python
