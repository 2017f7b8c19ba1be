#include "files/load_file.h"

#include <limits>

#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/recipe/recipe.h"
#include "lapwing/render/closed_surface.h"
#include "state/draft.h"
#include "work/crash_recovery.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<const Mesh> triangulated(Mesh mesh, const Progress& progress) {
  report_progress(progress, "topology", 0.0);
  mesh.topology();
  return std::make_shared<const Mesh>(std::move(mesh));
}

OpenedMesh read(const fs::path& path, const Progress& progress) {
  report_progress(progress, "read", 0.0);
  OpenedMesh opened{path.filename().string(), triangulated(read_mesh(path), progress),
                    stamp_of(path)};
  report_progress(progress, "colours", 0.0);
  FileColors colors = read_file_colors(*opened.mesh, path);
  // The window shows the notes about the mesh together with those about its colours.
  const std::vector<std::string> notes = reading_notes(*opened.mesh);
  colors.notes.insert(colors.notes.begin(), notes.begin(), notes.end());
  opened.colors = std::make_shared<const FilePaint>(std::move(colors));
  return opened;
}

LoadedFile examined(OpenedMesh opened, History history, const Progress& progress) {
  report_progress(progress, "check", 0.0);
  const Mesh& mesh = *opened.mesh;
  // Do not limit the number of listed defects, because the user may want to see all of them.
  CheckReport report = check(mesh, std::numeric_limits<std::size_t>::max());
  const bool closed = is_closed_outward(mesh.positions, mesh.topology().triangles);
  return {std::move(opened), std::move(report), std::move(history), closed};
}

LoadedFile unedited(OpenedMesh opened, const Progress& progress) {
  History history(open_state(opened.mesh));
  return examined(std::move(opened), std::move(history), progress);
}

LoadedFile carried_out(const Recipe& recipe, OpenedMesh opened, Kernels& kernels,
                       const Progress& progress) {
  History history = from_recipe(open_state(opened.mesh), recipe, carry_out_with(kernels, progress));
  // The recipe already contains these steps.
  history.mark_saved();
  return examined(std::move(opened), std::move(history), progress);
}

void carry_from_here(History& history, const std::vector<fs::path>& files) {
  if (files.empty()) return;
  // Commit the open step of the recipe first, because the files do not follow this step.
  history.perform(Commit{});
  for (const fs::path& file : files) {
    history.perform(CarryAlong{open_carried(fs::absolute(file).lexically_normal())});
  }
  history.mark_saved();
}

}  // namespace

LoadedFile load_file(const fs::path& path, const std::vector<fs::path>& carry, Kernels& kernels,
                     const Progress& progress) {
  if (path.extension() != ".json") {
    LoadedFile file = unedited(read(path, progress), progress);
    carry_from_here(file.history, carry);
    return file;
  }
  const Recipe recipe = read_recipe(path);
  LoadedFile file = carried_out(recipe, read(recipe.mesh_path(), progress), kernels, progress);
  carry_from_here(file.history, carry);
  return file;
}

LoadedFile load_shape(const NamedShape& shape) {
  return unedited({std::string(shape.name), triangulated(shape.make(), {}), {}, UpAxis::z}, {});
}

LoadedFile load_replay(const fs::path& recipe, History history, Kernels& kernels,
                       const Progress& progress) {
  const std::size_t before = history.done();
  perform(history, read_recipe(recipe), carry_out_with(kernels, progress));
  LoadedFile file{{}, {}, std::move(history)};
  file.replayed_from = before;
  return file;
}

LoadedFile load_interrupted(const InterruptedEdit& edit, Kernels& kernels,
                            const Progress& progress) {
  if (!edit.mesh_is_unchanged) {
    throw InputError(
        edit.mesh.path.string() +
        " has changed since the interrupted edit. Restore the file, or discard the edit.");
  }
  OpenedMesh opened = read(edit.mesh.path, progress);
  opened.name = edit.opened.filename().string();
  History history = restore_after_crash(open_state(opened.mesh), edit, kernels, progress);
  LoadedFile file = examined(std::move(opened), std::move(history), progress);
  file.restored = edit;
  return file;
}

}  // namespace lapwing::viewer
