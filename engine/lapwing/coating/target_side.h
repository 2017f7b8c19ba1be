#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "lapwing/coating/coater.h"
#include "lapwing/coating/correspondence.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/remesh/isotropic.h"

namespace lapwing {

/// A handle of the target on its way: where it is now, and the map that moves it.
struct TargetHandle {
  VertexSet vertices;
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
};

/// The target of a coat or mix: its patch, on the mesh that was given or, after `remesh`, on a
/// finer one of its own.
class TargetSide {
 public:
  /// Finds the patch. `mesh` must outlive the object. Throws what `resolve` and `disk_patch` do.
  TargetSide(const RegionSpec& patch, const Mesh& mesh);

  /// Finds the handles. Throws InputError, naming the handle's region: what `resolve` does, one
  /// that leaves the patch, is empty, or shares vertices with another.
  void choose_handles(std::span<const MovedHandle> handles);

  /// Takes the patch's features below `size` off what coatings and frames come to; 0: none.
  void smooth(double size, LaplacianWeights weights);

  /// Numbers per vertex of the mesh, which a remeshing interpolates. May be empty.
  void carry(std::vector<double> field) { field_ = std::move(field); }

  /// Makes the patch's edges as long as `length` says. What was smooth must be made so again.
  /// Returns what could not be done, for a person; mostly empty. Throws what `remesh_isotropic`
  /// does.
  std::string remesh(const std::function<double(const Eigen::Vector3d&)>& length,
                     const Progress& progress);
  /// What a vertex of the mesh that was given is called now: itself on the patch's border, the
  /// nearest inner one inside.
  Index renumbered(Index given, bool on_border) const;

  const Mesh& mesh() const { return finer_ ? finer_->remeshed.mesh : given_mesh_; }
  /// Null unless remeshed.
  RemeshResult* remeshed() { return finer_ ? &finer_->remeshed : nullptr; }
  const RemeshResult* remeshed() const { return finer_ ? &finer_->remeshed : nullptr; }

  const Patch& patch() const { return patch_; }
  const Positions& smooth_positions() const { return smooth_; }
  std::span<const double> field() const { return field_; }
  PlacedPatch placed() const { return {patch_, laid_}; }
  /// The patch's vertices as they are, own numbers.
  std::vector<Eigen::Vector3d> own_positions() const;
  const std::vector<TargetHandle>& handles() const { return handles_; }
  /// Where the handles take their vertices, ascending.
  std::vector<HeldVertex> held() const;

 private:
  struct Finer {
    RemeshResult remeshed;
    std::vector<Index> now;  ///< per vertex of the mesh given; kNoIndex for inner ones of the patch
    VertexSet inner;         ///< of the patch
  };
  const RegionSpec& spec_;
  const Mesh& given_mesh_;
  std::unique_ptr<Finer> finer_;
  Patch patch_;
  Positions smooth_;
  std::vector<Eigen::Vector3d> laid_;  ///< on the smooth surface, own numbers
  std::vector<double> field_;
  std::vector<TargetHandle> handles_;
};

}  // namespace lapwing
