#include "lapwing/coating/source_side.h"

#include <utility>

namespace lapwing {

SourceSide::SourceSide(const CoatSource& source, SharedSource mesh, const Mesh& target)
    : source_(source), shared_(std::move(mesh)), mesh_(shared_ ? *shared_ : target) {}

void SourceSide::take(TransferMode transfer, double size, LaplacianWeights weights,
                      Kernels& kernels) {
  Patch patch = disk_patch(resolve(source_.patch, mesh_), mesh_.topology(), mesh_.positions,
                           source_.patch.where);
  const auto take_off = transfer == TransferMode::coating ? peel_patch : whole_shape;
  coating_ = take_off(std::move(patch), mesh_.positions, mesh_.topology(), size, weights, kernels);
}

void SourceSide::lay(const CorrespondenceOptions& pairs) {
  laid_ = lapwing::lay(placed(), MapSide::source, pairs, source_.where);
}

}  // namespace lapwing
