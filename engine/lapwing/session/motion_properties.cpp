#include "lapwing/session/motion_properties.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/deform/vertex_motion.h"
#include "lapwing/io/mesh_format.h"

namespace lapwing {
namespace {

constexpr std::array<std::string_view, 8> kNames{"dx", "dy", "dz", "qw",
                                                 "qx", "qy", "qz", "stretch"};

std::array<double, kNames.size()> numbers_of(const VertexMotion& motion, std::size_t v) {
  const Eigen::Vector3d& d = motion.displacements[v];
  const Eigen::Quaterniond& q = motion.rotations[v];
  return {d.x(), d.y(), d.z(), q.w(), q.x(), q.y(), q.z(), motion.stretch[v]};
}

}  // namespace

Mesh with_vertex_motion(Mesh mesh, std::span<const Eigen::Vector3d> rest,
                        const std::filesystem::path& path) {
  const MeshFormat format = format_of(path);
  if (format != MeshFormat::ply) {
    throw InputError(path.string() + ": " + std::string(name_of(format)) +
                     " cannot store the motion of each vertex; save a .ply");
  }
  const VertexMotion motion = vertex_motion(rest, mesh.positions, mesh.topology());
  std::vector<ExtraAttribute>& extras = mesh.edit_attributes().vertex_extras;
  std::erase_if(extras, [](const ExtraAttribute& extra) {
    return std::find(kNames.begin(), kNames.end(), extra.name) != kNames.end();
  });
  const std::size_t first = extras.size();
  for (const std::string_view name : kNames) {
    extras.push_back({std::string(name), "double", 1, std::vector<double>(rest.size())});
  }
  for (std::size_t v = 0; v < rest.size(); ++v) {
    const auto numbers = numbers_of(motion, v);
    for (std::size_t k = 0; k < numbers.size(); ++k) extras[first + k].values[v] = numbers[k];
  }
  return mesh;
}

}  // namespace lapwing
