#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/coating/coater.h"
#include "lapwing/coating/correspondence.h"
#include "lapwing/coating/mix_weight.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/region/transition.h"

namespace lapwing {

/// Determines whether a step may change the triangles of its patch.
enum class Remeshing {
  automatic,  ///< if the patch is too coarse for the detail
  none,
};

/// How a coat or mix treats its target. Lengths are on the target.
struct CoatParameters {
  double smooth_target = 0.0;  ///< removes the target's detail below this; 0: none
  LaplacianWeights weights = LaplacianWeights::cotangent;
  Domain domain = Domain::disk;  ///< common domain of sources and target
  /// Default: smooth, as wide as the source's detail size on the target.
  std::optional<Transition> transition = {};
  Remeshing remesh = Remeshing::automatic;
  bool operator==(const CoatParameters&) const = default;
};

/// A source of a coat or mix, and how it is mapped to the target. Lengths are on the source.
struct CoatSource {
  RegionSpec patch = {};
  double detail_size = 0.0;  ///< above 0; smaller features are coating
  /// As in CorrespondenceOptions; target vertices are those of the mesh before any remeshing.
  std::vector<VertexPair> boundary_pairs = {};
  std::vector<VertexPair> inner_pairs = {};
  CoatOptions sampling = {};
  double amplitude = 1.0;
  std::string where = "source";  ///< as in RegionSpec; ignored by ==

  CorrespondenceOptions correspondence(Domain domain) const {
    return {domain, boundary_pairs, inner_pairs};
  }
  bool operator==(const CoatSource& other) const {
    return patch == other.patch && detail_size == other.detail_size &&
           boundary_pairs == other.boundary_pairs && inner_pairs == other.inner_pairs &&
           sampling == other.sampling && amplitude == other.amplitude;
  }
};

/// A request to put the fine detail of a patch of one mesh on a patch of another, without the
/// meshes. `Source` is a CoatSource, or one that also names its file, as in recipes
/// ({"op": "coat"}).
template <class Source>
struct CoatOf {
  Source source = {};
  RegionSpec target_patch = {};
  CoatParameters parameters = {};
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
  RegionSpec target_patch = {};
  std::array<Source, 2> sources = {};
  MixWeight weight = {};
  TransferMode transfer = TransferMode::coating;
  std::vector<MovedHandle> handles = {};  ///< in the patch; moved by the solve of the mix
  /// With TransferMode::shape, the target's frames are free of detail below `smooth_target`; 0
  /// stands for the mean of the sources' detail sizes, scaled to the target.
  CoatParameters parameters = {};
  std::string where = "mix";  ///< as in RegionSpec; ignored by ==
  bool operator==(const MixOf& other) const {
    return target_patch == other.target_patch && sources == other.sources &&
           weight == other.weight && transfer == other.transfer && handles == other.handles &&
           parameters == other.parameters;
  }
};
using MixRequest = MixOf<CoatSource>;

}  // namespace lapwing
