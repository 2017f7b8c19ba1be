#include "ui/load_file.h"

#include "lapwing/io/mesh_file.h"
#include "lapwing/render/closed_surface.h"
#include "lapwing/session/run_recipe.h"

namespace lapwing::viewer {
namespace {

LoadedFile examined(std::string name, Mesh mesh, const Progress& progress) {
  LoadedFile file;
  file.name = std::move(name);
  file.mesh = std::move(mesh);
  report_progress(progress, "topology", 0.0);
  file.topology = build_topology(file.mesh);
  report_progress(progress, "check", 0.0);
  file.report = check(file.mesh, file.topology);
  file.closed_outward = is_closed_outward(file.mesh.positions, file.topology.triangles);
  return file;
}

LoadedFile carried_out(const std::filesystem::path& path, Kernels& kernels,
                       const Progress& progress) {
  const auto result = run_recipe(read_recipe(path), kernels, progress);
  LoadedFile file = examined(path.filename().string(), std::move(result->mesh), progress);
  file.rest = std::move(result->original);
  if (result->last) file.classes = vertex_classes(result->last->region(), file.mesh.vertex_count());
  file.notes = std::move(result->report.warnings);
  return file;
}

}  // namespace

LoadedFile load_file(const std::filesystem::path& path, Kernels& kernels,
                     const Progress& progress) {
  if (path.extension() == ".json") return carried_out(path, kernels, progress);
  report_progress(progress, "read", 0.0);
  return examined(path.filename().string(), read_mesh(path), progress);
}

LoadedFile load_shape(const NamedShape& shape) {
  LoadedFile file = examined(std::string(shape.name), shape.make(), {});
  file.up_axis = UpAxis::z;
  return file;
}

}  // namespace lapwing::viewer
