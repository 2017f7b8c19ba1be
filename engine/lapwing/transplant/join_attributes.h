#pragma once

#include <array>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The face and corners from which a strip face copies its attributes.
struct StripSource {
  bool on_part = false;  ///< its loop edge is the part's
  Index face = 0;        ///< the face behind that edge, in its own mesh
  /// Corners of that face at the strip face's first and second corner; `apex_corner` is a corner of
  /// the other mesh at its third.
  std::array<Index, 2> corners{};
  Index apex_corner = 0;
  Index nearer = 0;  ///< which of `corners` is nearer to the apex
};

/// The vertices and faces of the joined mesh.
struct JoinPlan {
  const Mesh& host;
  const Mesh& part;
  std::vector<Index> part_kept;  ///< the part's vertices that were not welded, after the host's
  std::vector<StripSource> strip;
};

/// Returns the attributes of the joined mesh (join.h). Appends to `notes`.
MeshAttributes join_attributes(const JoinPlan& plan, const std::string& group,
                               std::vector<std::string>& notes);

}  // namespace lapwing
