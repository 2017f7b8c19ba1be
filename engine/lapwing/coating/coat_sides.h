#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "lapwing/coating/coat_request.h"
#include "lapwing/coating/coater.h"
#include "lapwing/coating/coating.h"
#include "lapwing/coating/correspondence.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/remesh/isotropic.h"

namespace lapwing {

/// A source mesh with shared ownership.
using SharedSource = std::shared_ptr<const Mesh>;

/// One source of a coat or mix: its patch, coating and map. Call the functions in the order below.
class SourceSide {
 public:
  /// If `mesh` is null, `target` is the source mesh. The other arguments must outlive the object.
  SourceSide(const CoatSource& source, SharedSource mesh, const Mesh& target);

  /// Extracts the detail below `size`, or the whole shape. Throws the errors of `resolve`,
  /// `disk_patch`, `peel_patch` and `whole_shape`.
  void take(TransferMode transfer, double size, LaplacianWeights weights, Kernels& kernels);
  const Coating& coating() const { return coating_; }
  const Mesh& mesh() const { return mesh_; }

  /// Maps the smooth surface to the domain, so that the detail does not influence the map.
  void lay(const CorrespondenceOptions& pairs);
  const FlattenedPatch& laid() const { return laid_; }
  PlacedPatch placed() const { return {coating_.patch, coating_.smooth}; }

  const CoatSource& asked() const { return source_; }

 private:
  const CoatSource& source_;
  SharedSource shared_;  ///< null if the target is the source
  const Mesh& mesh_;
  Coating coating_;
  FlattenedPatch laid_;
};

/// A handle of the target: its vertices in the current mesh, and its motion.
struct TargetHandle {
  VertexSet vertices;
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
};

/// The target of a coat or mix: its patch, on the given mesh or, after `remesh`, on a finer mesh.
class TargetSide {
 public:
  /// Finds the patch. `mesh` must outlive the object. Throws the errors of `resolve` and
  /// `disk_patch`.
  TargetSide(const RegionSpec& patch, const Mesh& mesh);

  /// Finds the vertices of the handles. Throws InputError, naming the handle's region, if a handle
  /// leaves the patch, is empty or overlaps another handle, and the errors of `resolve`.
  void choose_handles(std::span<const MovedHandle> handles);

  /// Fairs the patch, removing detail below `size`; 0 means none.
  void smooth(double size, LaplacianWeights weights);

  /// Sets a scalar field, one value per vertex of the mesh, which `remesh` interpolates. May be
  /// empty.
  void carry(std::vector<double> field) { field_ = std::move(field); }

  /// Remeshes the patch to the edge lengths that `length` returns. Call `smooth` again afterwards.
  /// Returns a message to the user if remeshing was incomplete, otherwise an empty string. Throws
  /// the errors of `remesh_isotropic`.
  std::string remesh(const std::function<double(const Eigen::Vector3d&)>& length,
                     const Progress& progress);
  /// Returns the current index of vertex `given` of the given mesh. An inner vertex is replaced by
  /// the nearest inner vertex.
  Index renumbered(Index given, bool on_border) const;

  const Mesh& mesh() const { return finer_ ? finer_->remeshed.mesh : given_mesh_; }
  /// Null unless remeshed.
  RemeshResult* remeshed() { return finer_ ? &finer_->remeshed : nullptr; }
  const RemeshResult* remeshed() const { return finer_ ? &finer_->remeshed : nullptr; }

  const Patch& patch() const { return patch_; }
  const Positions& smooth_positions() const { return smooth_; }
  std::span<const double> field() const { return field_; }
  PlacedPatch placed() const { return {patch_, laid_}; }
  /// Positions of the patch's vertices without smoothing, by local index.
  std::vector<Eigen::Vector3d> own_positions() const;
  const std::vector<TargetHandle>& handles() const { return handles_; }
  /// Returns the handle vertices with their displacements, ascending by vertex.
  std::vector<HeldVertex> held() const;

 private:
  struct Finer {
    RemeshResult remeshed;
    std::vector<Index> now;  ///< given vertex -> current index; kNoIndex inside the patch
    VertexSet inner;         ///< inner vertices of the patch
  };
  const RegionSpec& spec_;
  const Mesh& given_mesh_;
  std::unique_ptr<Finer> finer_;
  Patch patch_;
  Positions smooth_;
  std::vector<Eigen::Vector3d> laid_;  ///< on the smooth surface, by local index
  std::vector<double> field_;
  std::vector<TargetHandle> handles_;
};

}  // namespace lapwing
