#include "lapwing/session/prepared_coat.h"

namespace lapwing {

PreparedCoat::PreparedCoat(const CoatStep& step, const Mesh& mesh, const Topology& topology,
                           const std::filesystem::path& base_directory, Kernels& kernels,
                           const Progress& progress)
    : step_(std::make_unique<const CoatStep>(step)) {
  const LayeredStep layered{.sources = {&step_->source, 1},
                            .target_patch = step_->target_patch,
                            .parameters = step_->parameters,
                            .where = step_->where};
  layers_ =
      std::make_unique<LayeredCoat>(layered, mesh, topology, base_directory, kernels, progress);
}

PreparedCoat::~PreparedCoat() = default;
PreparedCoat::PreparedCoat(PreparedCoat&&) noexcept = default;
PreparedCoat& PreparedCoat::operator=(PreparedCoat&&) noexcept = default;

Positions PreparedCoat::positions(double amplitude) const {
  return layers_->positions(amplitude);
}

void PreparedCoat::set_detail_size(double size, const Progress& progress) {
  layers_->set_detail_size(0, size, progress);
}

}  // namespace lapwing
