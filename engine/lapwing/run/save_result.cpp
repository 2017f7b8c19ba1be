#include <algorithm>
#include <array>
#include <string_view>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/deform/vertex_motion.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/number_table.h"
#include "lapwing/run/run_recipe.h"

namespace lapwing {
namespace {

constexpr std::array<std::string_view, 8> kNames{"dx", "dy", "dz", "qw",
                                                 "qx", "qy", "qz", "stretch"};

std::array<double, kNames.size()> numbers_of(const VertexMotion& motion, std::size_t v) {
  const Eigen::Vector3d& d = motion.displacements[v];
  const Eigen::Quaterniond& q = motion.rotations[v];
  return {d.x(), d.y(), d.z(), q.w(), q.x(), q.y(), q.z(), motion.stretch[v]};
}

// Returns `mesh` with added vertex properties that describe the motion of each vertex from `rest`
// (VertexMotion). They are the displacement dx, dy, dz, the rotation qw, qx, qy, qz, and stretch,
// all in double precision. Existing properties with these names are replaced. Throws InputError if
// the output file `path` is not a PLY file.
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

// Writes a morph target into a glTF file. Other formats get a table of displacements, one row per
// vertex.
WriteReport write_morph_target(const Mesh& mesh, const RunResult& result,
                               const std::filesystem::path& path, FileReplacements& files) {
  if (is_gltf(format_of(path))) {
    return write_mesh(mesh, path, files,
                      {.morph_targets = {{result.morph_target, mesh.positions}}});
  }
  if (mesh.source == nullptr || result.original.size() != mesh.vertex_count()) {
    throw InputError(
        "a step changed the connectivity, so displacements are undefined; remove \"save_as\", or "
        "keep the connectivity (\"remesh\": \"none\")");
  }
  Mesh rest = mesh;
  rest.positions = result.original;
  WriteReport report = write_mesh(rest, path, files);
  Positions displacements = mesh.positions;
  for (std::size_t v = 0; v < displacements.size(); ++v) displacements[v] -= result.original[v];
  const auto table =
      path.parent_path() / (path.stem().string() + "-" + result.morph_target + ".npy");
  files.add(table, npy_bytes(displacements, Scalar::float64));
  report.notes.push_back("the mesh is saved unchanged; its displacements are saved in " +
                         table.string());
  return report;
}

}  // namespace

void save_result(RunResult& result, const std::filesystem::path& path, const SaveOptions& options) {
  const CancellationGuard whole;  // writes all of the files or none
  FileReplacements files;
  save_result(result, path, files, options);
  files.commit();
}

void save_result(RunResult& result, const std::filesystem::path& path, FileReplacements& files,
                 const SaveOptions& options) {
  const CancellationGuard whole;  // writes all of the files or none
  const Stopwatch watch;
  // Reject invalid outputs before anything is written.
  static_cast<void>(format_of(path));
  require_targets(result.carried, path, result.inputs);
  const bool marked = options.vertex_motion;
  const Mesh mesh = marked ? with_vertex_motion(result.mesh, result.original, path) : result.mesh;
  const auto add = [&](const WriteReport& written) {
    for (const std::string& line : written.not_carried) {
      result.report.warnings.push_back("not carried over: " + line);
    }
    result.warn(written.notes);
  };
  add(write_carried(result.carried, path, files));
  if (result.morph_target.empty()) {
    add(write_mesh(mesh, path, files, {.anew = marked, .original_file = result.read_from}));
  } else {
    add(write_morph_target(mesh, result, path, files));
  }
  result.report.timings.add("write", watch.elapsed_ms());
}

}  // namespace lapwing
