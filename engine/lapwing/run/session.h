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
/// If consecutive recipes have the same mesh, it is read and checked only once. From the second
/// recipe on, the state after common initial steps is cached, and so is the preparation of the next
/// step: if two deforms differ only in the motions of their handles, the second costs only one
/// solve. Results are bitwise identical to those of `run_recipe`. Files must not change during a
/// session.
///
/// The session stores the mesh, and one preparation for each step at which recipes diverged. Not
/// thread-safe.
class Session {
 public:
  /// The arguments must outlive the session.
  Session(Kernels& kernels, const MeshCache& meshes) : kernels_(kernels), meshes_(meshes) {}

  /// Runs `recipe` as `run_recipe` does. The report contains the original timings of reused steps.
  /// It omits stages that a cached preparation made unnecessary.
  std::unique_ptr<RunResult> run(const Recipe& recipe, const Progress& progress = {});

 private:
  // A step at which recipes diverged.
  struct Checkpoint {
    std::shared_ptr<const Mesh> read;  ///< the mesh of the recipes
    RunState after;                    ///< the state after their common steps
    std::optional<JoinedSurface> joined;
    DeformWorkspace workspace;  ///< workspace of the next step
  };

  void find_checkpoints(const Recipe& recipe, const Progress& progress);
  void run_step_at(Checkpoint& checkpoint, const Recipe& recipe, const Progress& progress,
                   RunResult& result);

  Kernels& kernels_;
  const MeshCache& meshes_;
  Recipe last_;
  std::size_t common_ = 0;               ///< number of common initial steps of the last two recipes
  std::vector<Checkpoint> checkpoints_;  ///< checkpoints of the last recipe, in order
};

}  // namespace lapwing
