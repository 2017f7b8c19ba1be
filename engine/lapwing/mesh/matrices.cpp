#include "lapwing/mesh/matrices.h"

#include <array>
#include <string>

#include "lapwing/base/errors.h"

namespace lapwing {

Mesh mesh_of(const Eigen::Ref<const Eigen::MatrixX3d>& V,
             const Eigen::Ref<const Eigen::MatrixX3i>& F) {
  Mesh mesh;
  mesh.positions.reserve(static_cast<std::size_t>(V.rows()));
  for (Eigen::Index v = 0; v < V.rows(); ++v) mesh.positions.emplace_back(V.row(v).transpose());
  Faces& faces = mesh.edit_faces();
  for (Eigen::Index f = 0; f < F.rows(); ++f) {
    std::array<Index, 3> corners{};
    for (Eigen::Index c = 0; c < 3; ++c) {
      const int vertex = F(f, c);
      if (vertex < 0 || vertex >= V.rows()) {
        throw InputError("F: row " + std::to_string(f) + " has vertex " + std::to_string(vertex) +
                         ", but V has " + std::to_string(V.rows()) +
                         " rows; vertices are numbered from 0");
      }
      corners[static_cast<std::size_t>(c)] = static_cast<Index>(vertex);
    }
    faces.add(corners);
  }
  return mesh;
}

}  // namespace lapwing
