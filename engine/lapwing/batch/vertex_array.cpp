#include "lapwing/batch/vertex_array.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/io/atomic_file.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/number_table.h"

namespace lapwing {

namespace fs = std::filesystem;

void write_vertex_array(const fs::path& path, std::span<const fs::path> meshes) {
  const auto first = std::ranges::find_if_not(meshes, &fs::path::empty);
  if (first == meshes.end()) {
    throw InputError(path.string() + ": no job has a result, so there are no vertices to write");
  }
  const std::size_t count = read_mesh(*first).vertex_count();
  const std::string failed = npy_rows(
      Positions(count, Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())),
      Scalar::float64);
  FileReplacement file(path);
  file.write(npy_header(std::array{meshes.size(), count, std::size_t{3}}, Scalar::float64));
  for (const fs::path& mesh : meshes) {
    if (mesh.empty()) {
      file.write(failed);
      continue;
    }
    const Positions positions = read_mesh(mesh).positions;
    if (positions.size() != count) {
      throw InputError(mesh.string() + " has " + std::to_string(positions.size()) +
                       " vertices, but " + first->string() + " has " + std::to_string(count) +
                       "; all results must have the same number of vertices");
    }
    file.write(npy_rows(positions, Scalar::float64));
  }
  file.commit();
}

}  // namespace lapwing
