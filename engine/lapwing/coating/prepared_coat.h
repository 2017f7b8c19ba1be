#pragma once

#include "lapwing/coating/layered_coat.h"

namespace lapwing {

/// A coat with fast changes of amplitude and detail size. Only construction is slow.
///
///     PreparedCoat coat(request, target, source, kernels, progress);
///     Positions positions = coat.positions(1.0);   // one addition
///     coat.set_detail_size(0.5);                   // one fairing and one back-substitution
///     coat.layers().mesh();                        // the mesh of these positions
class PreparedCoat {
 public:
  /// A null `source` is the target itself. `mesh` and `kernels` must outlive the object. Throws
  /// what LayeredCoat throws.
  PreparedCoat(const CoatRequest& request, const Mesh& mesh, SharedSource source, Kernels& kernels,
               const Progress& progress = {});

  /// Returns the positions of `layers().mesh()`, coated with this amplitude instead of the
  /// request's. With the request's detail size they equal those of `coat`, bit for bit. Throws
  /// SolverError if the amplitude makes positions overflow.
  Positions positions(double amplitude) const { return layers_->positions(amplitude); }

  /// See LayeredCoat::set_detail_size. Throws InputError if `size` is not above 0.
  void set_detail_size(double size, const Progress& progress = {}) {
    layers_->set_detail_size(0, size, progress);
  }

  /// Patches, maps, the resulting mesh, report and warnings. The source is number 0.
  const LayeredCoat& layers() const { return *layers_; }

 private:
  std::unique_ptr<LayeredCoat> layers_;
};

}  // namespace lapwing
