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

/// The mesh of `vertices`, numbers of shape (n, 3), and `faces`: whole numbers of shape (m, k), any
/// k from 3, or a list of polygons. Any type of number and order in memory. Throws InputError, with
/// the place and the vertices, for another shape or type and for a face that names a vertex that is
/// not there.
Mesh mesh_of(const py::object& vertices, const py::object& faces);

/// Positions of another pose: shape (n, 3) for the `count` vertices of a mesh.
Positions positions_of(const py::object& vertices, std::size_t count);

/// Shape (n, 3), a copy.
py::array_t<double> array_of(std::span<const Eigen::Vector3d> vectors);
py::array_t<Index> array_of(std::span<const Index> numbers);
/// Shape (m, k) where all polygons have k corners, else a list of arrays.
py::object faces_of(const Mesh& mesh);

/// The one of `choices` that is called `chosen`. Throws InputError, naming `place` and all of them,
/// where none is.
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

/// `count` moves for each of `handles` handles: numbers of shape (count, handles, 4, 4) or (count,
/// handles, 3, 4), row by row, acting on column vectors. Throws InputError, naming the place, for
/// another shape, a number that is not finite or a last row other than 0 0 0 1.
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
