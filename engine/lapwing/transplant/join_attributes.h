#pragma once

#include <array>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// What a face of the strip copies from.
struct StripSource {
  bool on_part = false;  ///< whose loop edge it stands on
  Index face = 0;        ///< the face behind that edge, in its own mesh
  /// That face's corners at the strip face's first and second, and a corner of the other mesh at
  /// its third.
  std::array<Index, 2> corners{};
  Index apex_corner = 0;
  Index nearer = 0;  ///< which of `corners` is nearer to the apex
};

/// How two meshes become one.
struct JoinPlan {
  const Mesh& host;
  const Mesh& part;
  std::vector<Index> part_kept;  ///< the part's vertices behind the host's
  std::vector<StripSource> strip;
};

/// The attributes of the joined mesh; see join.h. Appends to `notes`.
MeshAttributes join_attributes(const JoinPlan& plan, const std::string& group,
                               std::vector<std::string>& notes);

}  // namespace lapwing
