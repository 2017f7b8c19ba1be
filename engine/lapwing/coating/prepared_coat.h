#pragma once

#include "lapwing/coating/layered_coat.h"

namespace lapwing {

/// A coat in two: making it is slow, then amplitude and detail size are sliders.
///
///     PreparedCoat coat(request, target, source, kernels, progress);
///     Positions positions = coat.positions(1.0);   // one addition
///     coat.set_detail_size(0.5);                   // one fairing and one back-substitution
///     coat.layers().mesh();                        // whose positions they are
class PreparedCoat {
 public:
  /// A null `source` is the target itself. `mesh`, `topology` and `kernels` must outlive the
  /// object. Throws what LayeredCoat does.
  PreparedCoat(const CoatRequest& request, const Mesh& mesh, SharedSource source, Kernels& kernels,
               const Progress& progress = {});

  /// All of `layers().mesh()`, coated with this amplitude; that of the request has no say. As long
  /// as the detail size is the request's, what `coat` gives, bit for bit. Throws SolverError for an
  /// amplitude beyond all numbers.
  Positions positions(double amplitude) const { return layers_->positions(amplitude); }

  /// See LayeredCoat::set_detail_size. Throws InputError for a size not above 0.
  void set_detail_size(double size, const Progress& progress = {}) {
    layers_->set_detail_size(0, size, progress);
  }

  /// Patches, maps, the resulting mesh, report and warnings; the one source is number 0.
  const LayeredCoat& layers() const { return *layers_; }

 private:
  std::unique_ptr<LayeredCoat> layers_;
};

}  // namespace lapwing
