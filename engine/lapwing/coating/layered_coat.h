#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/base/warning.h"
#include "lapwing/coating/coat_request.h"
#include "lapwing/coating/coat_sides.h"
#include "lapwing/coating/correspondence.h"

namespace lapwing {

/// Report about one source of a coat or mix.
struct CoatSourceReport {
  std::size_t vertices = 0;        ///< number of vertices of the source patch
  std::vector<VertexPair> pins;    ///< the boundary pairs that were used
  std::size_t flipped_source = 0;  ///< number of triangles that a map flipped or flattened
  std::size_t flipped_target = 0;
  int warp_steps = 0;  ///< steps of the warp that makes inner pairs coincide
  int constrained_steps = 0;
  double mean_scale = 1.0;  ///< scale factor of the coating from the source to the target
};

/// Report of a coat or mix.
struct CoatReport {
  std::vector<CoatSourceReport> sources;      ///< one entry for a coat, two for a mix
  std::size_t vertices_before_remeshing = 0;  ///< of the target patch; 0 if it was not remeshed
  double transition_width = 0.0;
  double relative_residual = 0.0;
  double largest_displacement = 0.0;
  Index largest_displacement_vertex = kNoIndex;
};

/// The common form of coats and mixes: one or two sources and one target.
struct LayeredRequest {
  std::vector<CoatSource> sources;
  RegionSpec target_patch;
  CoatParameters parameters;
  std::string where;  ///< as in RegionSpec
  TransferMode transfer = TransferMode::coating;
  std::optional<MixWeight> weight = {};  ///< weight of the second source, if there are two
  std::vector<MovedHandle> handles = {};
};

template <class Source>
LayeredRequest layered(const CoatOf<Source>& coat) {
  return {.sources = {coat.source},
          .target_patch = coat.target_patch,
          .parameters = coat.parameters,
          .where = coat.where};
}

template <class Source>
LayeredRequest layered(const MixOf<Source>& mix) {
  return {.sources = {mix.sources[0], mix.sources[1]},
          .target_patch = mix.target_patch,
          .parameters = mix.parameters,
          .where = mix.where,
          .transfer = mix.transfer,
          .weight = mix.weight,
          .handles = mix.handles};
}

/// A coat or mix that is computed except for the amplitude. The sources are peeled, the target is
/// smoothed and, if too coarse, remeshed, the patches are mapped to each other, and the system is
/// factorized and solved.
class LayeredCoat {
 public:
  /// `sources` are the meshes of the request's sources; null means the target `mesh`. `mesh` and
  /// `kernels` must outlive the object. Reports the stages "peel", "map", "remesh", and those of
  /// `Coater`. Throws InputError if the request does not fit the meshes, SolverError, and
  /// Cancelled.
  LayeredCoat(LayeredRequest request, const Mesh& mesh, const std::vector<SharedSource>& sources,
              Kernels& kernels, const Progress& progress = {});
  LayeredCoat(const LayeredCoat&) = delete;

  /// Returns the positions of `mesh()` with `amplitude` times the layers, by one addition per
  /// vertex. Throws SolverError if positions are not finite or the residual is too large.
  Positions positions(double amplitude) const;

  /// Peels source `k` again with another detail size, by one fairing of the source and one
  /// back-substitution. Maps, transition and the target's system are not recomputed, so the result
  /// can differ slightly from that of a new object.
  void set_detail_size(std::size_t k, double size, const Progress& progress = {});

  /// The target before coating: the given mesh, or a mesh with a finer patch.
  const Mesh& mesh() const { return target_->mesh(); }
  /// Null unless the target was remeshed.
  const RemeshResult* remeshed() const { return target_->remeshed(); }

  std::size_t source_count() const { return layers_.size(); }
  const Patch& source_patch(std::size_t k) const { return layers_[k].source.coating().patch; }
  const Patch& target_patch() const { return target_->patch(); }
  /// The map between the target patch and source patch `k`.
  const Correspondence& map(std::size_t k) const { return layers_[k].map; }
  /// Returns the mix weight w at each vertex of the target patch; empty for one source.
  const std::vector<double>& weights() const { return weights_; }
  const std::vector<TargetHandle>& handles() const { return target_->handles(); }

  /// Returns the number of unknowns, the inner vertices of the patch.
  std::size_t free_count() const { return coater_->free().size(); }
  StageTimings timings() const;
  /// Returns the report for `result`, which must be a result of `positions`.
  CoatReport report(const Positions& result) const;
  /// Messages to the user, in the order of the stages.
  const std::vector<Warning>& warnings() const { return warnings_; }

 private:
  struct Layer {
    SourceSide source;
    CorrespondenceOptions pairs;  ///< target vertices as indices of the current mesh
    double amplitude = 1.0;
    FlattenedPatch laid_target = {};
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
  void note_inward_sides();
  void note_held_scales();
  void note_wide_transition();

  const LayeredRequest request_;
  const Mesh& mesh_;
  Kernels& kernels_;
  std::vector<Layer> layers_;
  std::optional<TargetSide> target_;
  std::vector<double> weights_;
  CoaterOptions options_;
  std::optional<Coater> coater_;
  std::size_t vertices_before_remeshing_ = 0;
  StageTimings timings_;
  std::vector<Warning> warnings_;
};

}  // namespace lapwing
