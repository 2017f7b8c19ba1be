#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/session/report.h"
#include "lapwing/session/run_recipe.h"
#include "lapwing/session/source_side.h"
#include "lapwing/session/target_side.h"

namespace lapwing {

/// What coat and mix steps have in common: what comes from one or two sources to one target. What
/// it refers to must outlive it.
struct LayeredStep {
  std::span<const CoatSource> sources;
  const RegionSpec& target_patch;
  const CoatParameters& parameters;
  const std::string& where;
  Taken taken = Taken::coating;
  const MixWeight* weight = nullptr;  ///< of the second of two sources; null for one
  std::span<const MovedHandle> handles = {};
};

/// A coat or mix step made ready: sources read and taken off, the target smooth, both laid on each
/// other, the target remeshed where it is too coarse, its system factored, and what comes to it
/// solved for.
class LayeredCoat {
 public:
  /// `mesh`, `topology` and `kernels` must outlive the object. Stages "source", "peel", "map",
  /// "remesh", and those of `Coater`. Throws what these steps throw, and Cancelled.
  LayeredCoat(const LayeredStep& step, const Mesh& mesh, const Topology& topology,
              const std::filesystem::path& base_directory, Kernels& kernels,
              const Progress& progress = {});
  LayeredCoat(const LayeredCoat&) = delete;

  /// `mesh()` with `amplitude` times what the layers bring. One addition per vertex of the patch.
  /// Throws SolverError when positions are not finite or the solution misses the equations.
  Positions positions(double amplitude) const;

  /// Takes source `k` off anew with another detail size: one fairing of the source and one
  /// back-substitution. Maps, transition and the target's system stay those of the size that the
  /// object was made with, so that a step with the new one can differ a little.
  void set_detail_size(std::size_t k, double size, const Progress& progress = {});

  /// What the target became: the mesh given, or one with a finer patch, before anything comes to
  /// it.
  const Mesh& mesh() const { return target_->mesh(); }
  const Topology& topology() const { return target_->topology(); }
  /// Null unless the target was remeshed.
  const RemeshResult* remeshed() const { return target_->remeshed(); }

  std::size_t source_count() const { return layers_.size(); }
  const Patch& source_patch(std::size_t k) const { return layers_[k].source.coating().patch; }
  const Patch& target_patch() const { return target_->patch(); }
  /// How the patches lie on each other in the domain.
  const Correspondence& map(std::size_t k) const { return layers_[k].map; }
  /// w at each vertex of the target patch; empty for one source.
  const std::vector<double>& weights() const { return weights_; }
  const std::vector<TargetHandle>& handles() const { return target_->handles(); }

  /// What was done, with the figures of `result`, which `positions` gave.
  StepReport report(const std::string& op, const Positions& result) const;
  /// For a person, in the order of the work.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Layer {
    SourceSide source;
    CorrespondenceOptions pairs;  ///< target vertices as they are called now
    double amplitude = 1.0;
    LaidPatch laid_target = {};
    Correspondence map = {};
  };
  template <class Body>
  void timed(const char* name, const Progress& progress, Body body);
  void make_sides(const Progress& progress);
  void lay_target();
  void meet();
  void remesh_where_coarse(const Progress& progress);
  double target_size() const;
  double ratio(const Layer& layer) const;
  double of_both(double first, double second) const;
  CoaterOptions coater_options() const;
  void make_coater();
  void take(const Progress& progress);
  void note_held_scales();
  void note_wide_transition();

  const LayeredStep step_;
  const Mesh& mesh_;
  const Topology& topology_;
  Kernels& kernels_;
  std::vector<Layer> layers_;
  std::optional<TargetSide> target_;
  std::vector<double> weights_;
  CoaterOptions options_;
  std::optional<Coater> coater_;
  std::size_t vertices_before_remeshing_ = 0;
  StageTimings timings_;
  std::vector<std::string> warnings_;
};

/// Puts what `coat` came to into `result`, the run that its mesh is of: mesh, `original`, region
/// and warnings. Returns the step's report.
StepReport take_over(const LayeredCoat& coat, const std::string& op, Positions positions,
                     RunResult& result);

}  // namespace lapwing
