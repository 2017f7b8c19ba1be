#pragma once

#include <string>
#include <vector>

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

/// The result of `coat` or `mix`.
struct Coated {
  Mesh mesh;  ///< the target, with a finer patch if it was remeshed
  CoatReport report;
  std::vector<std::string> warnings;  ///< messages to the user, in the order of the work
};

/// Puts the detail of a patch of `source` on a patch of `target` (paper, section 5). Runs on the
/// CPU. To vary amplitude or detail size, keep a PreparedCoat. Throws InputError, naming the region
/// or pair, if the request does not fit the meshes, and SolverError.
Coated coat(const Mesh& target, const Mesh& source, const CoatRequest& request);

/// The same with two sources; either may be `target`.
Coated mix(const Mesh& target, const Mesh& first, const Mesh& second, const MixRequest& request);

}  // namespace lapwing
