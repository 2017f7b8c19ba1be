#pragma once

#include <array>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The face and corners from which a strip face copies its attributes.
struct StripSource {
  bool on_part = false;  ///< whether its loop edge belongs to the part
  Index face = 0;        ///< the mesh face at this edge
  /// Corners of `face` at the first and second corner of the strip face. `apex_corner` is a corner
  /// of the other mesh at the third.
  std::array<Index, 2> corners{};
  Index apex_corner = 0;
  Index nearer = 0;  ///< which of `corners` is nearer to the apex
};

/// The vertices and faces of the joined mesh.
struct JoinPlan {
  const Mesh& host;
  const Mesh& part;
  /// The part's vertices that were not welded; they follow the host's vertices.
  std::vector<Index> part_kept;
  std::vector<StripSource> strip;
};

/// Returns the attributes of the joined mesh (join.h). Appends to `notes`.
MeshAttributes join_attributes(const JoinPlan& plan, const std::string& group,
                               std::vector<std::string>& notes);

}  // namespace lapwing
