#include "lapwing/coating/prepared_coat.h"

#include <utility>

namespace lapwing {

PreparedCoat::PreparedCoat(const CoatRequest& request, const Mesh& mesh, SharedSource source,
                           Kernels& kernels, const Progress& progress)
    : layers_(std::make_unique<LayeredCoat>(layered(request), mesh, std::vector{std::move(source)},
                                            kernels, progress)) {}

}  // namespace lapwing
