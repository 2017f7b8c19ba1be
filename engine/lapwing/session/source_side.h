#pragma once

#include <filesystem>
#include <memory>

#include "lapwing/coating/correspondence.h"
#include "lapwing/coating/peel.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// One source of a coat or mix step: the patch that it is taken from, and what is taken. Called in
/// the order below.
class SourceSide {
 public:
  /// Reads the source's mesh; without one it is `target` as it is before the step. All arguments
  /// must outlive the object. Throws what `read_mesh` does.
  SourceSide(const CoatSource& source, const std::filesystem::path& base_directory,
             const Mesh& target, const Topology& target_topology);

  /// Takes the detail below `size` off, or the whole shape. Throws what `resolve`, `disk_patch`,
  /// `peel` and `whole_shape` do.
  void take(Taken taken, double size, LaplacianWeights weights, Kernels& kernels);
  const Coating& coating() const { return coating_; }

  /// Lays the surface below the detail into the domain: the detail has no say in where it comes to.
  void lay(const CorrespondenceOptions& pairs);
  const LaidPatch& laid() const { return laid_; }
  PlacedPatch placed() const { return {coating_.patch, coating_.smooth}; }

  const CoatSource& asked() const { return source_; }

 private:
  struct Loaded {
    Mesh mesh;
    Topology topology;
  };
  const CoatSource& source_;
  std::unique_ptr<Loaded> loaded_;  ///< null where the target is the source
  const Mesh& mesh_;
  const Topology& topology_;
  Coating coating_;
  LaidPatch laid_;
};

}  // namespace lapwing
