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
/// If consecutive recipes have the same mesh, it is read and checked only once. The first steps
/// that two consecutive recipes share are not repeated from the second recipe on. The preparation
/// of the following step is cached: if two deforms differ only in the motions of their handles, the
/// second costs only one solve. Results are bitwise identical to those of `run_recipe`, whatever
/// the session ran before. Files must not change during a session.
///
/// The session stores the mesh, and one preparation for each step at which recipes began to differ.
/// The class is not thread-safe.
class Session {
 public:
  /// Both must outlive the session.
  Session(Kernels& kernels, const MeshCache& meshes) : kernels_(kernels), meshes_(meshes) {}

  /// Runs `recipe` as `run_recipe` does. The report contains the original timings of reused steps.
  /// It omits stages that were not needed because of a cached preparation.
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
  std::size_t common_ = 0;               ///< number of first steps that the last two recipes share
  std::vector<Checkpoint> checkpoints_;  ///< of the last recipe, in order
};

}  // namespace lapwing
