#pragma once

#include <memory>

#include "lapwing/coating/coat_request.h"
#include "lapwing/coating/correspondence.h"
#include "lapwing/coating/patch_coating.h"

namespace lapwing {

/// A mesh that detail is taken from, kept by those that use it.
using SharedSource = std::shared_ptr<const Mesh>;

/// One source of a coat or mix: the patch that it is taken from, and what is taken. Called in
/// the order below.
class SourceSide {
 public:
  /// Of `mesh` or, where that is null, of the target as it is before. The other arguments must
  /// outlive the object.
  SourceSide(const CoatSource& source, SharedSource mesh, const Mesh& target);

  /// Takes the detail below `size` off, or the whole shape. Throws what `resolve`, `disk_patch`,
  /// `peel_patch` and `whole_shape` do.
  void take(Taken taken, double size, LaplacianWeights weights, Kernels& kernels);
  const Coating& coating() const { return coating_; }

  /// Lays the surface below the detail into the domain: the detail has no say in where it comes to.
  void lay(const CorrespondenceOptions& pairs);
  const LaidPatch& laid() const { return laid_; }
  PlacedPatch placed() const { return {coating_.patch, coating_.smooth}; }

  const CoatSource& asked() const { return source_; }

 private:
  const CoatSource& source_;
  SharedSource shared_;  ///< null where the target is the source
  const Mesh& mesh_;
  Coating coating_;
  LaidPatch laid_;
};

}  // namespace lapwing
