#pragma once

#include <filesystem>
#include <memory>

#include "lapwing/session/layered_coat.h"

namespace lapwing {

/// A coat step in two: making it is slow, then amplitude and detail size are sliders.
///
///     PreparedCoat coat(step, mesh, topology, base_directory, kernels, progress);
///     Positions positions = coat.positions(1.0);   // one addition
///     coat.set_detail_size(0.5);                   // one fairing and one back-substitution
///     coat.layers().mesh();                        // whose positions they are
class PreparedCoat {
 public:
  /// `mesh`, `topology` and `kernels` must outlive the object; a source is looked for in
  /// `base_directory`. Throws what `run_recipe` does.
  PreparedCoat(const CoatStep& step, const Mesh& mesh, const Topology& topology,
               const std::filesystem::path& base_directory, Kernels& kernels,
               const Progress& progress = {});
  ~PreparedCoat();
  PreparedCoat(PreparedCoat&&) noexcept;
  PreparedCoat& operator=(PreparedCoat&&) noexcept;

  /// All of `layers().mesh()`, coated with this amplitude; that of the step has no say. As long as
  /// the detail size is the step's, what the step gives, bit for bit. Throws SolverError for an
  /// amplitude beyond all numbers.
  Positions positions(double amplitude) const;

  /// See LayeredCoat::set_detail_size. Throws InputError for a size not above 0.
  void set_detail_size(double size, const Progress& progress = {});

  /// Patches, maps, the resulting mesh, report and warnings; the one source is number 0.
  const LayeredCoat& layers() const { return *layers_; }

 private:
  std::unique_ptr<const CoatStep> step_;
  std::unique_ptr<LayeredCoat> layers_;
};

}  // namespace lapwing
