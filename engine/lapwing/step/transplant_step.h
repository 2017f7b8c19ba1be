#pragma once

#include <filesystem>
#include <memory>

#include "lapwing/mesh/mesh.h"
#include "lapwing/step/mesh_cache.h"
#include "lapwing/step/operation_words.h"
#include "lapwing/transplant/transplant_request.h"

namespace lapwing {

/// {"op": "transplant"}: replaces a region of the mesh by a part of another mesh.
struct TransplantStep : TransplantRequest {
  std::filesystem::path part;  ///< as written; empty: the mesh before the step
  bool operator==(const TransplantStep&) const = default;
};

constexpr OperationWords words_of(const TransplantStep*) {
  return {"transplant", "put a part of one mesh on another"};
}
void describe(TransplantStep& step, KeyVisitor& visitor);
/// Runs the step. `mesh` and `original` of the result are afterwards those of the joined mesh, with
/// the host's vertices first, in their order.
StepReport run_step(const TransplantStep& step, const StepContext& on);

/// Groups of keys that the panels show.
void describe(TransplantParameters& parameters, KeyVisitor& visitor);

/// Returns the mesh that holds the part of `step`, from `meshes` and relative to `base_directory`.
/// It is null if that is the edited mesh. Throws as `read_mesh` does.
std::shared_ptr<const Mesh> read_part_mesh(const TransplantStep& step,
                                           const std::filesystem::path& base_directory,
                                           const MeshCache& meshes);

}  // namespace lapwing
