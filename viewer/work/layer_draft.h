#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing::viewer {

/// A coat or mix in progress: the user's choices so far. Files have absolute paths. A patch that is
/// not chosen yet is an empty list.
struct LayerDraft {
  enum class Operation { coat, mix };

  Operation operation = Operation::coat;
  std::array<FileSource, 2> sources{nothing(), nothing()};  ///< a coat uses only the first one
  RegionSpec target_patch{ListedVertices{}, "target patch"};
  CoatParameters parameters;
  // Only for a mix:
  MixWeight weight;
  TransferMode transfer = TransferMode::coating;
  std::vector<MovedHandle> handles;

  bool operator==(const LayerDraft&) const = default;

  std::size_t source_count() const { return operation == Operation::coat ? 1 : 2; }
  std::span<const FileSource> all_sources() const { return {sources.data(), source_count()}; }

  /// Returns a source without a patch. Its detail size is unknown until there is one.
  static FileSource nothing();
};

/// Returns whether the user has chosen a patch, that is, whether `patch` is not an empty list of
/// vertices.
bool is_chosen(const RegionSpec& patch);

/// Returns the step of the draft. Throws InputError, which says what is still missing.
Step step_of(const LayerDraft& draft);

/// Returns the draft of a recipe's step, to change it; nothing for other operations.
std::optional<LayerDraft> layer_draft_of(const Step& step);

/// Returns whether the drafts are equal except for the detail sizes and, for a coat, the amplitude.
/// LayerPreview can then reuse its preparation.
bool same_but_for_sliders(const LayerDraft& a, const LayerDraft& b);

/// Returns the default detail size, a few times the mean edge length of the patch.
double usual_detail_size(const VertexSet& patch, const Mesh& mesh);

/// Returns the vertex on the border of the patch nearest to `vertex`. Throws what `disk_patch`
/// throws.
Index nearest_on_border(Index vertex, const VertexSet& patch, const Mesh& mesh);

}  // namespace lapwing::viewer
