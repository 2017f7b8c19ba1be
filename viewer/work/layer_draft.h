#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing::viewer {

/// A coat or a mix in the making: what a person has said of it so far. Files are named by absolute
/// paths; a patch that is not chosen yet is an empty list.
struct LayerDraft {
  enum class Operation { coat, mix };

  Operation operation = Operation::coat;
  std::array<FileSource, 2> sources{nothing(), nothing()};  ///< a coat has the first one alone
  RegionSpec target_patch{ListedVertices{}, "target patch"};
  CoatParameters parameters;
  // Of a mix:
  MixWeight weight;
  Taken taken = Taken::coating;
  std::vector<MovedHandle> handles;

  bool operator==(const LayerDraft&) const = default;

  std::size_t source_count() const { return operation == Operation::coat ? 1 : 2; }
  std::span<const FileSource> all_sources() const { return {sources.data(), source_count()}; }

  /// A source without patch, whose detail size is not known before there is one.
  static FileSource nothing();
};

/// The step that it says. Throws InputError, in words that say what is still missing.
Step step_of(const LayerDraft& draft);

/// What a step of a recipe says, to be changed; nothing for other operations.
std::optional<LayerDraft> layer_draft_of(const Step& step);

/// Whether b says what a does but for detail sizes and, for a coat, the amplitude, which come to
/// their result without preparing anew.
bool same_but_for_sliders(const LayerDraft& a, const LayerDraft& b);

/// A detail size to begin with: some edges of the patch long, so that bumps are smaller and shapes
/// larger.
double usual_detail_size(const VertexSet& patch, const Mesh& mesh);

/// The vertex on the border of the patch nearest to `vertex`. Throws what `disk_patch` does.
Index nearest_on_border(Index vertex, const VertexSet& patch, const Mesh& mesh);

}  // namespace lapwing::viewer
