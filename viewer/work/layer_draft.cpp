#include "work/layer_draft.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/parameterize/patch.h"
#include "lapwing/wrap/scan_surface.h"

namespace lapwing::viewer {
namespace {

// The default detail size in mean edge lengths. Users perceive smaller features as bumps.
constexpr double kEdgesPerDetail = 8.0;

// Number of pairs that place a source on the target.
constexpr std::size_t kPlacedPairs = 8;

// Returns the vertices of `patch` whose neighbours are all in it.
VertexSet without_border(const VertexSet& patch, const Mesh& mesh) {
  const std::vector<char> is_in_patch = vertex_mask(mesh.vertex_count(), patch);
  VertexSet inside;
  for (const Index v : patch) {
    if (std::ranges::all_of(mesh.topology().rings[v],
                            [&](Index n) { return is_in_patch[n] != 0; })) {
      inside.push_back(v);
    }
  }
  return inside;
}

void require_complete(const LayerDraft& draft) {
  for (std::size_t k = 0; k < draft.source_count(); ++k) {
    const FileSource& source = draft.sources[k];
    const std::string which = draft.source_count() == 1 ? "the source"
                              : k == 0                  ? "the first source"
                                                        : "the second source";
    if (!is_chosen(source.patch)) {
      throw InputError("Select a patch of " + which + ": drag a disk on it.");
    }
    if (!(source.detail_size > 0.0)) {
      throw InputError("The detail size of " + which + " must be above 0.");
    }
  }
  if (!is_chosen(draft.target_patch)) {
    throw InputError("Select the region that gets the detail: press I, then drag a disk.");
  }
}

}  // namespace

FileSource LayerDraft::nothing() {
  FileSource source;
  source.patch = {ListedVertices{}, "source patch"};
  return source;
}

bool is_chosen(const RegionSpec& patch) {
  const auto* list = std::get_if<ListedVertices>(&patch.form);
  return list == nullptr || !list->vertices.empty();
}

Step step_of(const LayerDraft& draft) {
  require_complete(draft);
  if (draft.operation == LayerDraft::Operation::coat) {
    CoatStep step;
    step.source = draft.sources[0];
    step.target_patch = draft.target_patch;
    step.parameters = draft.parameters;
    return step;
  }
  MixStep step;
  step.target_patch = draft.target_patch;
  step.sources = draft.sources;
  step.weight = draft.weight;
  step.transfer = draft.transfer;
  step.handles = draft.handles;
  step.parameters = draft.parameters;
  return step;
}

std::optional<LayerDraft> layer_draft_of(const Step& step) {
  LayerDraft draft;
  if (const auto* coat = std::get_if<CoatStep>(&step)) {
    draft.sources[0] = coat->source;
    draft.target_patch = coat->target_patch;
    draft.parameters = coat->parameters;
    return draft;
  }
  if (const auto* mix = std::get_if<MixStep>(&step)) {
    draft.operation = LayerDraft::Operation::mix;
    draft.sources = mix->sources;
    draft.target_patch = mix->target_patch;
    draft.parameters = mix->parameters;
    draft.weight = mix->weight;
    draft.transfer = mix->transfer;
    draft.handles = mix->handles;
    return draft;
  }
  return std::nullopt;
}

bool same_but_for_sliders(const LayerDraft& a, const LayerDraft& b) {
  LayerDraft like_b = a;
  for (std::size_t k = 0; k < a.sources.size(); ++k) {
    like_b.sources[k].detail_size = b.sources[k].detail_size;
  }
  if (a.operation == LayerDraft::Operation::coat) {
    like_b.sources[0].amplitude = b.sources[0].amplitude;
  }
  return like_b == b;
}

double usual_detail_size(const VertexSet& patch, const Mesh& mesh) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Index v : patch) {
    for (const Index n : mesh.topology().rings[v]) {
      sum += (mesh.positions[n] - mesh.positions[v]).norm();
      ++count;
    }
  }
  return count == 0 ? 0.0 : kEdgesPerDetail * sum / static_cast<double>(count);
}

Index nearest_on_border(Index vertex, const VertexSet& patch, const Mesh& mesh) {
  const Patch disk = disk_patch(patch, mesh.topology(), mesh.positions, "patch");
  const VertexSet border = border_of(disk);
  const Eigen::Vector3d place = mesh.positions[vertex];
  return *std::min_element(border.begin(), border.end(), [&](Index a, Index b) {
    return (mesh.positions[a] - place).squaredNorm() < (mesh.positions[b] - place).squaredNorm();
  });
}

RegionSpec patch_on(const Mesh& source, const Mesh& target, const VertexSet& patch) {
  const ScanSurface surface(target.topology(), target.positions);
  const std::vector<char> is_in_patch = vertex_mask(target.vertex_count(), patch);
  std::vector<Index> hints;
  ListedVertices list;
  const std::vector<Counterpart> on_target = counterparts_of(
      source.positions, ScanSurface(source.topology(), source.positions).normals(), surface, hints);
  for (Index v = 0; v < on_target.size(); ++v) {
    const auto& corners = on_target[v].point.corners;
    if (on_target[v].agrees &&
        std::ranges::all_of(corners, [&](Index c) { return is_in_patch[c] != 0; })) {
      list.vertices.push_back(v);
    }
  }
  if (list.vertices.empty()) {
    throw InputError(
        "The source does not lie on the region. Select another region, or drag a disk "
        "on the source.");
  }
  return {DiskInRegion{{{std::move(list), "source patch"}}}, "source patch"};
}

std::vector<VertexPair> pairs_on(const Mesh& source, const VertexSet& source_patch,
                                 const Mesh& target, const VertexSet& patch) {
  const VertexSet inside = without_border(patch, target);
  const VertexSet source_inside = without_border(source_patch, source);
  std::vector<VertexPair> pairs;
  if (source_inside.empty()) return pairs;
  const auto nearest = [&](Index v) {
    return *std::ranges::min_element(source_inside, {}, [&](Index s) {
      return (source.positions[s] - target.positions[v]).squaredNorm();
    });
  };
  // Each vertex is as far as possible from the earlier ones and from the border.
  std::vector<double> distances(inside.size(), std::numeric_limits<double>::infinity());
  const auto mark = [&](Index from) {
    for (std::size_t k = 0; k < inside.size(); ++k) {
      distances[k] = std::min(distances[k],
                              (target.positions[inside[k]] - target.positions[from]).squaredNorm());
    }
  };
  for (const Index v : subtract(patch, inside)) mark(v);
  while (pairs.size() < std::min(kPlacedPairs, inside.size())) {
    const auto farthest = std::ranges::max_element(distances) - distances.begin();
    const Index v = inside[static_cast<std::size_t>(farthest)];
    pairs.push_back({nearest(v), v});
    mark(v);
  }
  return pairs;
}

}  // namespace lapwing::viewer
