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

/// Determines whether a coat or mix may change the triangles of its target patch.
enum class Remeshing {
  automatic,  ///< only if the patch is too coarse for the detail
  none,
};

/// Parameters of a coat or mix that concern the target. Lengths are measured on the target.
struct CoatParameters {
  double smooth_target = 0.0;  ///< removes target detail smaller than this; 0 means none
  LaplacianWeights weights = LaplacianWeights::cotangent;
  Domain domain = Domain::disk;  ///< common domain of sources and target
  /// By default, a smooth transition whose width is the source's detail size, scaled to the target.
  std::optional<Transition> transition = {};
  Remeshing remesh = Remeshing::automatic;
  bool operator==(const CoatParameters&) const = default;
};

/// A source of a coat or mix, and the parameters of its map. Lengths are measured on the source.
struct CoatSource {
  RegionSpec patch = {};
  double detail_size = 0.0;  ///< positive; smaller features belong to the coating
  /// As in CorrespondenceOptions. Target vertices are vertices of the mesh before remeshing.
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

/// A request to transfer the fine detail of a patch of one mesh to a patch of another, without the
/// meshes. `Source` is CoatSource or, in recipes ({"op": "coat"}), a source that also names its
/// file.
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

/// The component of a source that replaces the same component of the target.
enum class TransferMode {
  coating,  ///< the detail below each source's detail size; added to the target
  shape,    ///< the full Laplacians; frames do not contain detail below the detail size
};

/// A request to transfer (1 - w) times the first and w times the second of two sources to one patch
/// (paper, section 5.3), without the meshes ({"op": "mix"}). `Source` is as in CoatOf.
template <class Source>
struct MixOf {
  RegionSpec target_patch = {};
  std::array<Source, 2> sources = {};
  MixWeight weight = {};
  TransferMode transfer = TransferMode::coating;
  std::vector<MovedHandle> handles = {};  ///< in the patch; moved in the solve of the mix
  /// With TransferMode::shape, the target's frames do not contain detail below `smooth_target`; 0
  /// means the mean of the sources' detail sizes, scaled to the target.
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
