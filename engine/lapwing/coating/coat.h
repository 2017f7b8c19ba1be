#pragma once

#include <string>
#include <vector>

#include "lapwing/coating/layered_coat.h"

namespace lapwing {

/// A coat whose amplitude and detail size can be changed quickly. Only construction is slow.
///
///     PreparedCoat coat(request, target, source, kernels, progress);
///     Positions positions = coat.positions(1.0);   // one addition
///     coat.set_detail_size(0.5);                   // one fairing and one back-substitution
///     coat.layers().mesh();                        // the mesh of these positions
class PreparedCoat {
 public:
  /// If `source` is null, the target `mesh` is also the source. `mesh` and `kernels` must outlive
  /// the object. Throws the errors of LayeredCoat.
  PreparedCoat(const CoatRequest& request, const Mesh& mesh, SharedSource source, Kernels& kernels,
               const Progress& progress = {});

  /// Returns the positions of `layers().mesh()` coated with `amplitude` instead of the request's.
  /// For the request's detail size, they are bitwise equal to the result of `coat`. Throws
  /// SolverError if the amplitude makes positions overflow.
  Positions positions(double amplitude) const { return layers_->positions(amplitude); }

  /// See LayeredCoat::set_detail_size. Throws InputError unless `size` is positive.
  void set_detail_size(double size, const Progress& progress = {}) {
    layers_->set_detail_size(0, size, progress);
  }

  /// Patches, maps, the resulting mesh, report and warnings. The source has index 0.
  const LayeredCoat& layers() const { return *layers_; }

 private:
  std::unique_ptr<LayeredCoat> layers_;
};

/// The result of `coat` or `mix`.
struct Coated {
  Mesh mesh;  ///< the target, with a finer patch if the patch was remeshed
  CoatReport report;
  std::vector<std::string> warnings;  ///< messages to the user, in the order of the stages
};

/// Transfers the detail of a patch of `source` to a patch of `target` (paper, section 5). Runs on
/// the CPU. To vary amplitude or detail size, use a PreparedCoat. Throws SolverError, and
/// InputError, naming the region or pair, if the request does not fit the meshes.
Coated coat(const Mesh& target, const Mesh& source, const CoatRequest& request);

/// Mixes the detail of two sources on a patch of `target`. Either may be `target`.
Coated mix(const Mesh& target, const Mesh& first, const Mesh& second, const MixRequest& request);

}  // namespace lapwing
