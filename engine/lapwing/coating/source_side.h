#pragma once

#include <memory>

#include "lapwing/coating/coat_request.h"
#include "lapwing/coating/correspondence.h"
#include "lapwing/coating/patch_coating.h"

namespace lapwing {

/// A source mesh with shared ownership.
using SharedSource = std::shared_ptr<const Mesh>;

/// One source of a coat or mix: its patch, and what is taken from it. Call the functions in the
/// order below.
class SourceSide {
 public:
  /// Uses `mesh` or, if that is null, the target as it is given. The other arguments must outlive
  /// the object.
  SourceSide(const CoatSource& source, SharedSource mesh, const Mesh& target);

  /// Takes the detail below `size`, or the whole shape. Throws what `resolve`, `disk_patch`,
  /// `peel_patch` and `whole_shape` throw.
  void take(TransferMode transfer, double size, LaplacianWeights weights, Kernels& kernels);
  const Coating& coating() const { return coating_; }

  /// Maps the surface without its detail to the domain, so that detail does not influence the map.
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

}  // namespace lapwing
