#include "lapwing/coating/coat_sides.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/coating/fairing.h"
#include "lapwing/deform/handle_motion.h"

namespace lapwing {

using Eigen::Vector3d;

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

TargetSide::TargetSide(const RegionSpec& patch, const Mesh& mesh)
    : spec_(patch),
      given_mesh_(mesh),
      patch_(disk_patch(resolve(patch, mesh), mesh.topology(), mesh.positions, patch.where)) {}

void TargetSide::choose_handles(std::span<const MovedHandle> handles) {
  VertexSet chosen;
  for (const MovedHandle& handle : handles) {
    const std::string& where = handle.region.where;
    const VertexSet vertices = resolve(handle.region, mesh());
    if (vertices.empty()) {
      throw InputError(where + ": the handle has no vertices; name at least one");
    }
    if (const VertexSet outside = subtract(vertices, patch_.vertices); !outside.empty()) {
      throw InputError(where + ": the handle leaves the target patch at " + name_vertices(outside) +
                           "; enlarge the patch, or remove them from the handle",
                       outside);
    }
    if (const VertexSet shared = intersect(vertices, chosen); !shared.empty()) {
      throw InputError(where + ": the handle shares " + name_vertices(shared) +
                           " with another handle; remove them from one of the two, for example "
                           "with \"minus\"",
                       shared);
    }
    chosen = unite(chosen, vertices);
    const Vector3d centroid = handle_frame(vertices, mesh().positions).centroid;
    handles_.push_back({vertices, to_affine(handle.move, centroid)});
  }
}

void TargetSide::smooth(double size, LaplacianWeights weights) {
  smooth_ = size > 0.0 ? smooth_around(patch_.vertices, size, mesh().positions, mesh().topology(),
                                       weights, "smooth_target")
                       : mesh().positions;
  laid_ = on_patch<Vector3d>(patch_, smooth_);
}

std::string TargetSide::remesh(const std::function<double(const Vector3d&)>& length,
                               const Progress& progress) {
  auto finer = std::make_unique<Finer>();
  if (field_.empty()) {
    finer->remeshed = remesh_isotropic(mesh(), patch_.vertices, length, {}, progress);
  } else {
    Mesh with_field = mesh();
    with_field.edit_attributes().vertex_extras.push_back(
        {"carried", "double", 1, std::move(field_)});
    finer->remeshed = remesh_isotropic(with_field, patch_.vertices, length, {}, progress);
    auto& extras = finer->remeshed.mesh.edit_attributes().vertex_extras;
    field_ = std::move(extras.back().values);
    extras.pop_back();
  }
  const RemeshResult& remeshed = finer->remeshed;
  finer->now = inverse_index(remeshed.kept, given_mesh_.vertex_count());
  finer->inner = remeshed.region;
  std::erase_if(finer->inner, [&](Index v) { return remeshed.kept[v] != kNoIndex; });
  if (finer->inner.empty()) finer->inner = remeshed.region;
  patch_ =
      disk_patch(remeshed.region, remeshed.mesh.topology(), remeshed.mesh.positions, spec_.where);
  finer_ = std::move(finer);
  for (TargetHandle& handle : handles_) {
    std::vector<Index> vertices;
    for (const Index v : handle.vertices) {
      const bool stayed = finer_->now[v] != kNoIndex;
      vertices.push_back(renumbered(v, stayed));
    }
    handle.vertices = make_vertex_set(std::move(vertices));
  }
  return finer_->remeshed.note;
}

Index TargetSide::renumbered(Index given, bool on_border) const {
  if (!finer_) return given;
  if (on_border) return finer_->now[given];
  const Positions& positions = finer_->remeshed.mesh.positions;
  const Vector3d place = given_mesh_.positions[given];
  const VertexSet& inner = finer_->inner;
  return *std::min_element(inner.begin(), inner.end(), [&](Index a, Index b) {
    return (positions[a] - place).squaredNorm() < (positions[b] - place).squaredNorm();
  });
}

std::vector<Vector3d> TargetSide::own_positions() const {
  return on_patch<Vector3d>(patch_, mesh().positions);
}

std::vector<HeldVertex> TargetSide::held() const {
  std::vector<HeldVertex> held;
  for (const TargetHandle& handle : handles_) {
    for (const Index v : handle.vertices) {
      const Vector3d& p = mesh().positions[v];
      held.push_back({v, handle.motion * p - p});
    }
  }
  // After remeshing, two handles can share a vertex. The vertex then belongs to the first handle.
  const auto by_vertex = [](const HeldVertex& a, const HeldVertex& b) {
    return a.vertex < b.vertex;
  };
  std::stable_sort(held.begin(), held.end(), by_vertex);
  const auto same = [](const HeldVertex& a, const HeldVertex& b) { return a.vertex == b.vertex; };
  held.erase(std::unique(held.begin(), held.end(), same), held.end());
  return held;
}

}  // namespace lapwing
