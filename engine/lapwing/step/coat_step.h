#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/coating/coat_request.h"
#include "lapwing/coating/layered_coat.h"
#include "lapwing/step/mesh_shelf.h"
#include "lapwing/step/operation_words.h"

namespace lapwing {

/// A source with its file.
struct FileSource : CoatSource {
  /// As written; empty: the mesh that the step is carried out on, as it is before the step.
  std::filesystem::path mesh;
  bool operator==(const FileSource&) const = default;
};

/// {"op": "coat"}: put the fine detail of a patch of one mesh on a patch of the mesh.
using CoatStep = CoatOf<FileSource>;

/// {"op": "mix"}: mix two surfaces on a patch of the mesh.
using MixStep = MixOf<FileSource>;

constexpr OperationWords words_of(const CoatStep*) {
  return {"coat", "put the fine detail of one surface on another", " from "};
}
constexpr OperationWords words_of(const MixStep*) {
  return {"mix", "mix the detail of two surfaces on a third"};
}
void describe(CoatStep& step, KeyVisitor& visitor);
void describe(MixStep& step, KeyVisitor& visitor);

/// Carries it out. Where the patch has to be remeshed, mesh and `original` of the result are those
/// of the finer mesh afterwards.
StepReport run_step(const CoatStep& step, const StepRun& on);
StepReport run_step(const MixStep& step, const StepRun& on);

/// The keys of parts of it, which panels show.
void describe(CoatParameters& parameters, KeyVisitor& visitor);
void describe(CoatOptions& options, KeyVisitor& visitor);
void describe(Transition& transition, KeyVisitor& visitor);
void describe(FileSource& source, KeyVisitor& visitor);

/// The meshes of `sources`, as `meshes` has them for a recipe in `base_directory`; null for one
/// without a file. Throws what `read_mesh` does.
std::vector<SharedSource> read_source_meshes(std::span<const FileSource> sources,
                                             const std::filesystem::path& base_directory,
                                             const MeshShelf& meshes);

}  // namespace lapwing
