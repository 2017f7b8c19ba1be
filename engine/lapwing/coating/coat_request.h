#pragma once

#include <array>
#include <string>
#include <vector>

#include "lapwing/coating/coat_parameters.h"
#include "lapwing/coating/coat_source.h"
#include "lapwing/coating/mix_weight.h"
#include "lapwing/deform/deform_request.h"

namespace lapwing {

/// Put the fine detail of a patch of one mesh on a patch of another: all of it but the meshes.
/// `Source` is a CoatSource, or one that also names its file, as in recipes ({"op": "coat"}).
template <class Source>
struct CoatOf {
  Source source;
  RegionSpec target_patch;
  CoatParameters parameters;
  std::string where = "coat";  ///< as in RegionSpec; no part of the value
  bool operator==(const CoatOf& other) const {
    return source == other.source && target_patch == other.target_patch &&
           parameters == other.parameters;
  }
};
using CoatRequest = CoatOf<CoatSource>;

/// What is taken of a source, and replaced of the target.
enum class Taken {
  coating,  ///< the detail below each source's detail size, which lies over the target
  shape,    ///< all of it: full Laplacians; detail sizes say what frames are free of
};

/// Put two sources on one patch, (1 - w) of the first and w of the second (paper, section 5.3): all
/// of it but the meshes. `Source` as in CoatOf ({"op": "mix"}).
template <class Source>
struct MixOf {
  RegionSpec target_patch;
  std::array<Source, 2> sources;
  MixWeight weight;
  Taken taken = Taken::coating;
  std::vector<MovedHandle> handles;  ///< in the patch, moved in the same solve
  /// With Taken::shape `smooth_target` is what the target's frames are free of; 0: of what the
  /// sources' are, as large as that is on the target.
  CoatParameters parameters;
  std::string where = "mix";  ///< as in RegionSpec; no part of the value
  bool operator==(const MixOf& other) const {
    return target_patch == other.target_patch && sources == other.sources &&
           weight == other.weight && taken == other.taken && handles == other.handles &&
           parameters == other.parameters;
  }
};
using MixRequest = MixOf<CoatSource>;

}  // namespace lapwing
