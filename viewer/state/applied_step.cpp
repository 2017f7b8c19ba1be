#include "state/applied_step.h"

#include "lapwing/step/step.h"
#include "state/command.h"

namespace lapwing::viewer {
namespace {

bool same_faces(const Mesh& a, const Mesh& b) {
  return a.vertex_count() == b.vertex_count() && a.face_starts() == b.face_starts() &&
         a.face_vertices() == b.face_vertices();
}

std::shared_ptr<const AppliedStep> difference(const Mesh& before, RunResult result) {
  if (same_faces(before, result.mesh)) {
    return std::make_shared<const AppliedStep>(
        moved_vertices(before.positions, result.mesh.positions));
  }
  return std::make_shared<const AppliedStep>(std::make_shared<const Mesh>(std::move(result.mesh)));
}

}  // namespace

CarriedOut apply_step(const AppState& state, const Step& step,
                      const std::filesystem::path& base_directory, Kernels& kernels,
                      const Progress& progress) {
  const AppState committed = apply(state, Commit{});
  RunResult result;
  result.mesh = *committed.rest;
  result.original = committed.rest->positions;
  CarriedOut out;
  out.report =
      run_step(step, {committed.steps.size() + 1, base_directory, kernels, progress, result});
  out.warnings = std::move(result.report.warnings);
  const std::vector<std::string>& notes = result.report.notes;
  out.warnings.insert(out.warnings.end(), notes.begin(), notes.end());
  result.deformed = {};
  out.result = difference(*committed.rest, std::move(result));
  return out;
}

}  // namespace lapwing::viewer
