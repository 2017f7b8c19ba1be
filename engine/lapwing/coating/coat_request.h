#pragma once

#include <array>
#include <string>
#include <vector>

#include "lapwing/coating/coat_parameters.h"
#include "lapwing/coating/coat_source.h"
#include "lapwing/coating/mix_weight.h"
#include "lapwing/deform/deform_request.h"

namespace lapwing {

/// A request to put the fine detail of a patch of one mesh on a patch of another, without the
/// meshes. `Source` is a CoatSource, or one that also names its file, as in recipes
/// ({"op": "coat"}).
template <class Source>
struct CoatOf {
  Source source;
  RegionSpec target_patch;
  CoatParameters parameters;
  std::string where = "coat";  ///< as in RegionSpec; ignored by ==
  bool operator==(const CoatOf& other) const {
    return source == other.source && target_patch == other.target_patch &&
           parameters == other.parameters;
  }
};
using CoatRequest = CoatOf<CoatSource>;

/// What is taken from a source and replaced on the target.
enum class TransferMode {
  coating,  ///< the detail below each source's detail size, which is put on the target
  shape,    ///< the full Laplacians; frames are free of detail below the detail size
};

/// A request to put two sources on one patch, (1 - w) of the first and w of the second (paper,
/// section 5.3), without the meshes. `Source` is as in CoatOf ({"op": "mix"}).
template <class Source>
struct MixOf {
  RegionSpec target_patch;
  std::array<Source, 2> sources;
  MixWeight weight;
  TransferMode transfer = TransferMode::coating;
  std::vector<MovedHandle> handles;  ///< in the patch, moved in the same solve
  /// With TransferMode::shape, the target's frames are free of detail below `smooth_target`; 0
  /// stands for the mean of the sources' detail sizes, scaled to the target.
  CoatParameters parameters;
  std::string where = "mix";  ///< as in RegionSpec; ignored by ==
  bool operator==(const MixOf& other) const {
    return target_patch == other.target_patch && sources == other.sources &&
           weight == other.weight && transfer == other.transfer && handles == other.handles &&
           parameters == other.parameters;
  }
};
using MixRequest = MixOf<CoatSource>;

}  // namespace lapwing
