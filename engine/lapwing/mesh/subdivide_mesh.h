#pragma once

#include <string>

#include "lapwing/base/cancellation.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Options for refining a whole mesh.
struct SubdivideRequest {
  int times = 1;                    ///< at least 1
  bool smooth = false;  ///< whether to use Loop's scheme; otherwise the shape does not change
  std::string where = "subdivide";  ///< name in messages; ignored by ==
  bool operator==(const SubdivideRequest& other) const {
    return times == other.times && smooth == other.smooth;
  }
};

/// Triangulates `mesh` and subdivides it (subdivide.h) `times` times. The given vertices come
/// first. Colours and texture coordinates are interpolated, and a new vertex copies other
/// properties from an end of its edge. Triangles copy the attributes of their face. Drops stored
/// normals. Throws InputError, naming `request.where`, if `times` is less than 1, and the errors of
/// `require_subdividable` and `subdivide`; throws Cancelled. Stage "subdivide".
Mesh subdivide(const Mesh& mesh, const SubdivideRequest& request, const Progress& progress = {});

}  // namespace lapwing
