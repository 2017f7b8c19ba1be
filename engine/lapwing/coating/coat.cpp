#include "lapwing/coating/coat.h"

#include <utility>

#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {
namespace {

// Returns null if `source` is the target itself, to reuse its topology.
SharedSource shared(const Mesh& source, const Mesh& target) {
  if (&source == &target) return nullptr;
  return std::make_shared<const Mesh>(source);
}

Coated result_of(const LayeredCoat& layers, double amplitude) {
  Coated coated;
  Positions positions = layers.positions(amplitude);
  coated.report = layers.report(positions);
  coated.warnings = texts_of(layers.warnings());
  coated.mesh = layers.mesh();
  coated.mesh.positions = std::move(positions);
  return coated;
}

}  // namespace

PreparedCoat::PreparedCoat(const CoatRequest& request, const Mesh& mesh, SharedSource source,
                           Kernels& kernels, const Progress& progress)
    : layers_(std::make_unique<LayeredCoat>(layered(request), mesh, std::vector{std::move(source)},
                                            kernels, progress)) {}

Coated coat(const Mesh& target, const Mesh& source, const CoatRequest& request) {
  CpuKernels kernels;
  const PreparedCoat prepared(request, target, shared(source, target), kernels);
  return result_of(prepared.layers(), request.source.amplitude);
}

Coated mix(const Mesh& target, const Mesh& first, const Mesh& second, const MixRequest& request) {
  CpuKernels kernels;
  const LayeredCoat layers(layered(request), target,
                           {shared(first, target), shared(second, target)}, kernels);
  return result_of(layers, 1.0);
}

}  // namespace lapwing
