#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lapwing/run/run_recipe.h"

namespace lapwing {

/// Runs recipes one after another, faster than `run_recipe` if they are similar:
///
///     Session session(kernels, meshes);
///     for (const Recipe& variant : variants) save_result(*session.run(variant), ...);
///
/// Consecutive recipes with the same mesh read and check it once. From the second recipe on, the
/// first steps that two recipes share run only once. The step after those keeps its preparation: if
/// two deforms differ only in the motions of their handles, the second is one solve. Results have
/// the bits of `run_recipe`, whatever ran before. Files must not change meanwhile.
///
/// Memory: the mesh, and one preparation for each place where recipes diverged so far. Not
/// thread-safe.
class Session {
 public:
  /// Both must outlive the session.
  Session(Kernels& kernels, const MeshCache& meshes) : kernels_(kernels), meshes_(meshes) {}

  /// Runs `recipe` as `run_recipe` does. The report keeps the timings of reused steps and omits the
  /// stages that a kept preparation saved.
  std::unique_ptr<RunResult> run(const Recipe& recipe, const Progress& progress = {});

 private:
  // A place where recipes diverged.
  struct Checkpoint {
    std::shared_ptr<const Mesh> read;  ///< the mesh of the recipes
    RunState after;                    ///< the state after their common steps
    std::optional<JoinedSurface> joined;
    DeformWorkspace workspace;  ///< of the next step
  };

  void find_checkpoints(const Recipe& recipe, const Progress& progress);
  void run_step_at(Checkpoint& checkpoint, const Recipe& recipe, const Progress& progress,
                   RunResult& result);

  Kernels& kernels_;
  const MeshCache& meshes_;
  Recipe last_;
  std::size_t common_ = 0;               ///< number of common first steps of the last two recipes
  std::vector<Checkpoint> checkpoints_;  ///< of the last recipe, in order
};

}  // namespace lapwing
