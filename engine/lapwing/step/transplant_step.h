#pragma once

#include <filesystem>
#include <memory>

#include "lapwing/mesh/mesh.h"
#include "lapwing/step/mesh_shelf.h"
#include "lapwing/step/operation_words.h"
#include "lapwing/transplant/transplant_request.h"

namespace lapwing {

/// {"op": "transplant"}: put a part of another mesh in the place of a region of the mesh.
struct TransplantStep : TransplantRequest {
  std::filesystem::path part;  ///< as written; empty: the mesh itself, before the step
  bool operator==(const TransplantStep&) const = default;
};

constexpr OperationWords words_of(const TransplantStep*) {
  return {"transplant", "put a part of one mesh on another"};
}
void describe(TransplantStep& step, KeyVisitor& visitor);
/// Mesh and `original` of the result are those of the joined one afterwards: the host's vertices
/// first, in their order.
StepReport run_step(const TransplantStep& step, const StepRun& on);

/// The keys that panels show.
void describe(TransplantParameters& parameters, KeyVisitor& visitor);

/// The mesh that the part of `step` is or is cut from, as `meshes` has it for a recipe in
/// `base_directory`; null where that is the mesh itself. Throws what `read_mesh` does.
std::shared_ptr<const Mesh> read_part_mesh(const TransplantStep& step,
                                           const std::filesystem::path& base_directory,
                                           const MeshShelf& meshes);

}  // namespace lapwing
