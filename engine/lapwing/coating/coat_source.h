#pragma once

#include <string>
#include <vector>

#include "lapwing/coating/coater.h"
#include "lapwing/coating/correspondence.h"
#include "lapwing/region/region_spec.h"

namespace lapwing {

/// A source of a coat or mix, and how it is mapped to the target. Lengths are on the source.
struct CoatSource {
  RegionSpec patch;
  double detail_size = 0.0;  ///< above 0; smaller features are coating
  /// As in CorrespondenceOptions; target vertices are those of the mesh before any remeshing.
  std::vector<VertexPair> boundary_pairs;
  std::vector<VertexPair> inner_pairs;
  CoatOptions sampling;
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

}  // namespace lapwing
