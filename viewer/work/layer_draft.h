#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing::viewer {

/// The user's choices for a coat or mix. File paths are absolute. A patch that is not chosen yet is
/// an empty vertex list.
struct LayerDraft {
  enum class Operation { coat, mix };

  Operation operation = Operation::coat;
  std::array<FileSource, 2> sources{nothing(), nothing()};  ///< a coat uses only sources[0]
  RegionSpec target_patch{ListedVertices{}, "target patch"};
  CoatParameters parameters;
  // The following members are used only by a mix.
  MixWeight weight;
  TransferMode transfer = TransferMode::coating;
  std::vector<MovedHandle> handles;

  bool operator==(const LayerDraft&) const = default;

  std::size_t source_count() const { return operation == Operation::coat ? 1 : 2; }
  std::span<const FileSource> all_sources() const { return {sources.data(), source_count()}; }

  /// Returns a source without a patch. Its detail size is not set until the patch is chosen.
  static FileSource nothing();
};

/// Returns whether the user has chosen the patch: whether it is not an empty vertex list.
bool is_chosen(const RegionSpec& patch);

/// Returns the step of the draft. Throws InputError if a part of it is missing.
Step step_of(const LayerDraft& draft);

/// Returns the draft of a coat or mix step. Returns nullopt for other operations.
std::optional<LayerDraft> layer_draft_of(const Step& step);

/// Returns whether the drafts are equal except for the detail sizes and, for a coat, the amplitude.
/// LayerPreview can then reuse its preparation.
bool same_but_for_sliders(const LayerDraft& a, const LayerDraft& b);

/// Returns the default detail size, a few times the mean edge length of the patch.
double usual_detail_size(const VertexSet& patch, const Mesh& mesh);

/// Returns the vertex on the border of the patch that is nearest to `vertex`. Throws the errors of
/// `disk_patch`.
Index nearest_on_border(Index vertex, const VertexSet& patch, const Mesh& mesh);

/// Returns the largest disk in the part of `source` that lies on `patch` of `target`. Throws
/// InputError if no part does.
RegionSpec patch_on(const Mesh& source, const Mesh& target, const VertexSet& patch);
/// Returns a few pairs of vertices at the same positions, spread over the interior of both patches.
std::vector<VertexPair> pairs_on(const Mesh& source, const VertexSet& source_patch,
                                 const Mesh& target, const VertexSet& patch);

}  // namespace lapwing::viewer
