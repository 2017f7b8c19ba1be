#include "lapwing/session/source_side.h"

#include "lapwing/io/mesh_file.h"

namespace lapwing {
namespace {

template <class Loaded>
std::unique_ptr<Loaded> load_source(const std::filesystem::path& mesh,
                                    const std::filesystem::path& base_directory) {
  if (mesh.empty()) return nullptr;
  auto loaded = std::make_unique<Loaded>();
  loaded->mesh = read_mesh(base_directory / mesh);
  loaded->topology = build_topology(loaded->mesh);
  return loaded;
}

}  // namespace

SourceSide::SourceSide(const CoatSource& source, const std::filesystem::path& base_directory,
                       const Mesh& target, const Topology& target_topology)
    : source_(source),
      loaded_(load_source<Loaded>(source.mesh, base_directory)),
      mesh_(loaded_ ? loaded_->mesh : target),
      topology_(loaded_ ? loaded_->topology : target_topology) {}

void SourceSide::take(Taken taken, double size, LaplacianWeights weights, Kernels& kernels) {
  Patch patch = disk_patch(resolve(source_.patch, mesh_, topology_), topology_, mesh_.positions,
                           source_.patch.where);
  const auto take_off = taken == Taken::coating ? peel : whole_shape;
  coating_ = take_off(std::move(patch), mesh_.positions, topology_, size, weights, kernels);
}

void SourceSide::lay(const CorrespondenceOptions& pairs) {
  laid_ = lapwing::lay(placed(), MapSide::source, pairs, source_.where);
}

}  // namespace lapwing
