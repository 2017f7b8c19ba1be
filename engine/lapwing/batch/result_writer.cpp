#include "lapwing/batch/result_writer.h"

#include <algorithm>

#include "lapwing/base/errors.h"
#include "lapwing/io/atomic_file.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/number_table.h"
#include "lapwing/io/paths.h"
#include "lapwing/run/report_json.h"
#include "lapwing/run/run_recipe.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void require_no_input(const fs::path& path, const RunResult& result) {
  for (const fs::path& input : result.inputs) {
    if (!is_same_file(path, input)) continue;
    throw InputError(path.string() + " is an input of the recipe; choose another folder or id");
  }
}

// Sets the paths of all attachment files, named after the job, and returns their names.
std::vector<std::string> name_carried(const Job& job, const fs::path& folder, RunResult& result) {
  std::vector<std::string> names;
  for (AttachmentFile& file : result.carried) {
    names.push_back(job.id + "-" + file.file().stem().string() + "-carried" +
                    file.file().extension().string());
    file.save = folder / names.back();
  }
  return names;
}

Json line_of(const Job& job, const std::string& file, const RunReport& report) {
  Json line{{"id", job.id}, {"job", text_of(job.asked)}, {"file", file}};
  bool settled = true;
  Json certificate;
  Json wrap;
  for (const StepReport& step : report.steps) {
    if (step.wrap) wrap = json_of(*step.wrap);
    if (!step.deform) continue;
    settled = settled && step.deform->certificate.settled;
    certificate = json_of(step.deform->certificate);
  }
  line["settled"] = settled;
  if (!certificate.is_null()) line["certificate"] = std::move(certificate);
  if (!wrap.is_null()) line["wrap"] = std::move(wrap);
  line["warnings"] = report.warnings;
  line["notes"] = report.notes;
  return line;
}

}  // namespace

std::string BatchOutput::words() const {
  if (!displacements) return "mesh " + extension;
  return "displacements " + std::to_string(size_of(*displacements));
}

ResultWriter::ResultWriter(fs::path folder, BatchOutput output, const MeshCache& meshes,
                           fs::path first_mesh)
    : folder_(std::move(folder)),
      output_(std::move(output)),
      meshes_(meshes),
      first_mesh_(std::move(first_mesh)) {
  if (!output_.extension.empty()) format_of("mesh." + output_.extension);
}

std::string ResultWriter::file_name(const Job& job, const Recipe& recipe) const {
  if (output_.displacements) return job.id + ".npy";
  if (!output_.extension.empty()) return job.id + "." + output_.extension;
  return job.id + (recipe.save.empty() ? ".ply" : recipe.save.extension().string());
}

std::string ResultWriter::write_rest(const Recipe& recipe, const Mesh& rest) {
  const fs::path mesh = recipe.mesh_path();
  std::string name = "rest.ply";
  if (mesh != first_mesh_) {
    const fs::path seen_from_there = mesh.lexically_proximate(first_mesh_.parent_path());
    name =
        "rest-" + mesh.stem().string() + "-" + text_of(hash_of(seen_from_there.string())) + ".ply";
  }
  const std::lock_guard lock(mutex_);
  if (rests_.insert(name).second) write_mesh(rest, folder_ / name);
  return name;
}

void ResultWriter::write_displacements(const fs::path& path, const Mesh& rest,
                                       const RunResult& result, Scalar type) const {
  Positions displacements = result.mesh.positions;
  for (std::size_t v = 0; v < displacements.size(); ++v) displacements[v] -= rest.positions[v];
  FileReplacements files;
  write_carried(result.carried, path, files);
  files.add(path, npy_bytes(displacements, type));
  files.commit();
}

std::string ResultWriter::write(const Job& job, const Recipe& recipe, RunResult& result) {
  const std::string name = file_name(job, recipe);
  const fs::path path = folder_ / name;
  const std::vector<std::string> carried = name_carried(job, folder_, result);
  require_no_input(path, result);
  std::string rest_name;
  if (const std::optional<Scalar> type = output_.displacements) {
    const auto rest = meshes_.mesh(recipe.base_directory, recipe.mesh);
    const bool is_alike = rest->vertex_count() == result.mesh.vertex_count() &&
                          rest->face_starts() == result.mesh.face_starts() &&
                          rest->face_vertices() == result.mesh.face_vertices();
    if (!is_alike) {
      throw InputError(
          "the recipe changes the connectivity, so displacements are undefined; write meshes with "
          "--format, or keep the connectivity (\"remesh\": \"none\")");
    }
    rest_name = write_rest(recipe, *rest);
    require_targets(result.carried, path, result.inputs);
    write_displacements(path, *rest, result, *type);
  } else {
    save_result(result, path);
  }
  Json line = line_of(job, name, result.report);
  if (!rest_name.empty()) line["rest"] = rest_name;
  if (!carried.empty()) line["carried"] = carried;
  // File names and names inside files are not always UTF-8.
  return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lapwing
