#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/coating/coat_request.h"
#include "lapwing/coating/layered_coat.h"
#include "lapwing/step/mesh_cache.h"
#include "lapwing/step/operation_words.h"

namespace lapwing {

/// A coat source with the file of its mesh.
struct FileSource : CoatSource {
  /// As written in the recipe. Empty for the edited mesh itself, as it is before the step.
  std::filesystem::path mesh;
  bool operator==(const FileSource&) const = default;
};

/// {"op": "coat"}: puts the fine detail of a patch of one mesh on a patch of the edited mesh.
using CoatStep = CoatOf<FileSource>;

/// {"op": "mix"}: mixes two surfaces on a patch of the edited mesh.
using MixStep = MixOf<FileSource>;

constexpr OperationWords words_of(const CoatStep*) {
  return {"coat", "put the fine detail of one surface on another", " from "};
}
constexpr OperationWords words_of(const MixStep*) {
  return {"mix", "mix the detail of two surfaces on a third"};
}
void describe(CoatStep& step, KeyVisitor& visitor);
void describe(MixStep& step, KeyVisitor& visitor);

/// Runs the step. If the patch has to be remeshed, `mesh` and `original` of the result are
/// afterwards those of the finer mesh.
StepReport run_step(const CoatStep& step, const StepContext& on);
StepReport run_step(const MixStep& step, const StepContext& on);

/// Groups of keys that the panels show.
void describe(CoatParameters& parameters, KeyVisitor& visitor);
void describe(CoatOptions& options, KeyVisitor& visitor);
void describe(Transition& transition, KeyVisitor& visitor);
void describe(FileSource& source, KeyVisitor& visitor);

/// Returns the mesh of each source, from `meshes` and relative to `base_directory`. It is null for
/// a source without a file. Throws as `read_mesh` does.
std::vector<SharedSource> read_source_meshes(std::span<const FileSource> sources,
                                             const std::filesystem::path& base_directory,
                                             const MeshCache& meshes);

}  // namespace lapwing
