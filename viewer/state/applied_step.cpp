#include "state/applied_step.h"

#include "lapwing/step/step.h"
#include "state/command.h"

namespace lapwing::viewer {
namespace {

bool same_faces(const Mesh& a, const Mesh& b) {
  return a.vertex_count() == b.vertex_count() && a.face_starts() == b.face_starts() &&
         a.face_vertices() == b.face_vertices();
}

std::shared_ptr<const AppliedStep> difference(const AppState& before, const Step& step,
                                              RunResult result) {
  if (same_faces(*before.rest, result.mesh)) {
    MovedVertices moved = moved_vertices(before.rest->positions, result.mesh.positions);
    const auto* deform = std::get_if<DeformRequest>(&step);
    if (deform != nullptr && !deform->carry.empty()) {
      moved.carried = share(std::move(result.carried));
    }
    return std::make_shared<const AppliedStep>(std::move(moved));
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
  result.carried = carried_at_rest(committed.carried);
  CarriedOut out;
  out.report =
      run_step(step, {committed.steps.size() + 1, base_directory, kernels, progress, result, {}});
  out.warnings = std::move(result.report.warnings);
  const std::vector<std::string>& notes = result.report.notes;
  out.warnings.insert(out.warnings.end(), notes.begin(), notes.end());
  result.deformed = {};
  out.result = difference(committed, step, std::move(result));
  return out;
}

}  // namespace lapwing::viewer
