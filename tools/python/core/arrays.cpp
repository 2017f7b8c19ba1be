#include "arrays.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lapwing/base/errors.h"

namespace lapwing::python {
namespace {

std::string shape_of(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
    text += (axis == 0 ? "" : ", ") + std::to_string(array.shape(axis));
  }
  return text + (array.ndim() == 1 ? ",)" : ")");
}

std::string type_of(const py::handle& object) {
  return py::str(py::type::handle_of(object).attr("__name__"));
}

bool is_whole(const py::array& array) {
  const char kind = array.dtype().kind();
  return kind == 'i' || kind == 'u';
}

bool is_real(const py::array& array) {
  return is_whole(array) || array.dtype().kind() == 'f';
}

py::array as_array(const py::object& object, const std::string& name) {
  py::array array = py::array::ensure(object);
  if (!array) {
    PyErr_Clear();
    throw InputError(name + ": expected an array of numbers, got " + type_of(object));
  }
  return array;
}

// Returns real numbers in row-major order.
py::array_t<double, py::array::c_style | py::array::forcecast> as_numbers(const py::array& array,
                                                                          const std::string& name) {
  if (!is_real(array)) {
    throw InputError(name + ": expected real numbers, got an array of type " +
                     std::string(py::str(array.dtype())));
  }
  return array;
}

Positions read_positions(const py::object& vertices) {
  const py::array given = as_array(vertices, "vertices");
  if (given.ndim() != 2 || given.shape(1) != 3) {
    throw InputError("vertices: expected shape (n, 3), got " + shape_of(given));
  }
  const auto numbers = as_numbers(given, "vertices");
  Positions positions(static_cast<std::size_t>(given.shape(0)));
  const double* const data = numbers.data();
  for (std::size_t v = 0; v < positions.size(); ++v) {
    positions[v] = Eigen::Vector3d(data[3 * v], data[3 * v + 1], data[3 * v + 2]);
  }
  return positions;
}

// The largest number of corners in typical face arrays, which contain triangles or quads.
constexpr std::size_t kMostCornersInRows = 4;

// Collects polygons and checks that all their vertices exist.
class FaceReader {
 public:
  FaceReader(Faces& faces, std::size_t vertex_count) : faces_(faces), count_(vertex_count) {}

  void read_table(const py::array& table) {
    const auto corners = static_cast<std::size_t>(table.shape(1));
    if (corners < 3) {
      throw InputError("faces: expected shape (m, 3), (m, 4) or more corners, got " +
                       shape_of(table));
    }
    const auto count = static_cast<std::size_t>(table.shape(0));
    // Detect a transposed array. It has few rows, and each row contains one corner of every face.
    if (count <= kMostCornersInRows && corners > 2 * kMostCornersInRows && 2 * corners > count_) {
      throw InputError("faces: " + std::to_string(count) + " faces of " + std::to_string(corners) +
                       " corners have too many for the " + std::to_string(count_) +
                       " vertices. A row must be a face; pass the transposed array (faces.T)");
    }
    const auto numbers = signed_numbers(table);
    const long long* const data = numbers.data();
    faces_.vertices.reserve(count * corners);
    faces_.starts.reserve(count + 1);
    for (std::size_t f = 0; f < count; ++f) add(std::span(data + f * corners, corners));
  }

  void read_list(const py::sequence& polygons) {
    for (std::size_t f = 0; f < polygons.size(); ++f) {
      const std::string name = "faces[" + std::to_string(f) + "]";
      const py::array polygon = as_array(polygons[f], name);
      if (polygon.ndim() != 1 || polygon.size() < 3 || !is_whole(polygon)) {
        throw InputError(name + ": expected at least 3 whole numbers, got " +
                         std::string(py::str(polygons[f])));
      }
      const auto numbers = signed_numbers(polygon);
      add(std::span(numbers.data(), static_cast<std::size_t>(numbers.size())));
    }
  }

 private:
  using Signed = py::array_t<long long, py::array::c_style | py::array::forcecast>;

  // Numbers that are too large for the type become negative, and `add` rejects negative numbers.
  static Signed signed_numbers(const py::array& array) { return array; }

  void add(std::span<const long long> polygon) {
    for (const long long v : polygon) {
      if (v >= 0 && static_cast<unsigned long long>(v) < count_) {
        faces_.vertices.push_back(static_cast<Index>(v));
        continue;
      }
      std::vector<Index> vertices;
      if (v >= 0 && v < kNoIndex) vertices.push_back(static_cast<Index>(v));
      throw InputError("faces[" + std::to_string(faces_.count()) + "] names vertex " +
                           std::to_string(v) + ", but there are " + std::to_string(count_) +
                           " vertices, numbered from 0",
                       std::move(vertices));
    }
    faces_.starts.push_back(static_cast<Index>(faces_.vertices.size()));
  }

  Faces& faces_;
  std::size_t count_;
};

void read_faces(const py::object& faces, Mesh& mesh) {
  FaceReader reader(mesh.edit_faces(), mesh.vertex_count());
  const bool is_list = py::isinstance<py::list>(faces) || py::isinstance<py::tuple>(faces);
  if (is_list) return reader.read_list(faces);
  const py::array table = as_array(faces, "faces");
  if (table.size() == 0) return;
  if (table.dtype().kind() == 'O' && table.ndim() == 1) return reader.read_list(table);
  if (!is_whole(table)) {
    throw InputError("faces: expected whole numbers, got an array of type " +
                     std::string(py::str(table.dtype())) + "; convert them with .astype(int)");
  }
  if (table.ndim() != 2) {
    throw InputError(
        "faces: expected shape (m, 3), (m, 4) or more corners, or a list of polygons, got shape " +
        shape_of(table));
  }
  reader.read_table(table);
}

}  // namespace

Mesh mesh_of(const py::object& vertices, const py::object& faces) {
  Mesh mesh;
  mesh.positions = read_positions(vertices);
  read_faces(faces, mesh);
  return mesh;
}

Positions positions_of(const py::object& vertices, std::size_t count) {
  Positions positions = read_positions(vertices);
  if (positions.size() != count) {
    throw InputError("vertices: expected " + std::to_string(count) +
                     " vertices, as the mesh has, got " + std::to_string(positions.size()));
  }
  return positions;
}

py::array_t<double> array_of(std::span<const Eigen::Vector3d> vectors) {
  py::array_t<double> array({static_cast<py::ssize_t>(vectors.size()), py::ssize_t{3}});
  double* to = array.mutable_data();
  for (const Eigen::Vector3d& v : vectors) to = std::copy(v.data(), v.data() + 3, to);
  return array;
}

py::array_t<Index> array_of(std::span<const Index> numbers) {
  return py::array_t<Index>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

py::object faces_of(const Mesh& mesh) {
  const std::size_t count = mesh.face_count();
  const std::size_t corners = count == 0 ? 3 : mesh.face(0).size();
  bool alike = true;
  for (std::size_t f = 0; f < count && alike; ++f) alike = mesh.face(f).size() == corners;
  if (alike) {
    py::array_t<Index> table({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(corners)});
    const std::vector<Index>& all = mesh.face_vertices();
    std::copy(all.begin(), all.end(), table.mutable_data());
    return table;
  }
  py::list polygons;
  for (std::size_t f = 0; f < count; ++f) polygons.append(array_of(mesh.face(f)));
  return polygons;
}

py::iterator arrays_of(const Mesh& mesh) {
  return py::iter(py::make_tuple(array_of(mesh.positions), faces_of(mesh)));
}

py::object read_only(py::object arrays) {
  if (py::isinstance<py::list>(arrays)) {
    for (const py::handle& array : arrays) array.attr("setflags")(py::arg("write") = false);
  } else {
    arrays.attr("setflags")(py::arg("write") = false);
  }
  return arrays;
}

Motions::Motions(const py::object& array, std::size_t handles) : handles_(handles) {
  const py::array given = as_array(array, "motions");
  const bool fits = given.ndim() == 4 && given.shape(3) == 4 &&
                    (given.shape(2) == 3 || given.shape(2) == 4) &&
                    static_cast<std::size_t>(given.shape(1)) == handles;
  if (!fits) {
    throw InputError("motions: expected shape (count, " + std::to_string(handles) +
                     ", 4, 4), a matrix for each handle, got " + shape_of(given));
  }
  const auto numbers = as_numbers(given, "motions");
  numbers_.assign(numbers.data(), numbers.data() + numbers.size());
  count_ = static_cast<std::size_t>(given.shape(0));
  rows_ = static_cast<std::size_t>(given.shape(2));
  for (std::size_t m = 0; m < count_ * handles_; ++m) {
    const std::span<const double> all = std::span(numbers_).subspan(m * rows_ * 4, rows_ * 4);
    const auto fail = [&](const std::string& what) {
      throw InputError("motions[" + std::to_string(m / handles_) + ", " +
                       std::to_string(m % handles_) + "]: " + what);
    };
    for (const double number : all) {
      if (!std::isfinite(number)) fail("a number is not finite");
    }
    if (rows_ == 3) continue;
    const auto last = all.last(4);
    if (last[0] != 0.0 || last[1] != 0.0 || last[2] != 0.0 || last[3] != 1.0) {
      fail("expected the last row 0 0 0 1: a handle's motion is affine");
    }
  }
}

Eigen::Matrix<double, 3, 4> Motions::matrix(std::size_t k, std::size_t handle) const {
  using Rows = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(numbers_.data() + (k * handles_ + handle) * rows_ * 4);
}

}  // namespace lapwing::python
