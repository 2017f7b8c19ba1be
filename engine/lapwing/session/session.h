#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// Carries out recipes one after the other, sooner than `run_recipe` where they are alike:
///
///     Session session(kernels, meshes);
///     for (const Recipe& variant : variants) save_result(*session.run(variant), ...);
///
/// The mesh is read, and examined, once for all recipes that follow each other with the same one.
/// The steps with which two recipes begin alike are carried out once, from the second recipe on.
/// The step after those keeps its preparation: where two deforms differ in the motions of their
/// handles alone, the second is one solve. Results are those of `run_recipe` to the bit, whatever
/// was run before; files are taken not to change meanwhile.
///
/// Memory: that of the mesh and of one preparation for each place where recipes parted so far.
/// One thread at a time.
class Session {
 public:
  /// Both must outlive the session.
  Session(Kernels& kernels, const MeshShelf& meshes) : kernels_(kernels), meshes_(meshes) {}

  /// As `run_recipe`; the report's timings are of what was to be done.
  std::unique_ptr<RunResult> run(const Recipe& recipe, const Progress& progress = {});

 private:
  // Where recipes parted.
  struct Fork {
    std::shared_ptr<const Mesh> read;  ///< what the recipes begin with
    RunState after;                    ///< the steps that they have in common
    std::optional<JoinedSurface> joined;
    DeformWorkspace workspace;  ///< of the step that came next
  };

  void find_forks(const Recipe& recipe, const Progress& progress);
  void run_step_at(Fork& fork, const Recipe& recipe, const Progress& progress, RunResult& result);

  Kernels& kernels_;
  const MeshShelf& meshes_;
  Recipe last_;
  std::size_t common_ = 0;   ///< steps with which the last two recipes begin alike
  std::vector<Fork> forks_;  ///< on the way of the last recipe, in order
};

}  // namespace lapwing
