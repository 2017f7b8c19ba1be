#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing::viewer {

/// A mesh repaired by `fix`, ready to show.
struct RepairedMesh {
  std::shared_ptr<const Mesh> mesh;
  FixReport done;
  CheckReport left;  ///< what is still wrong
};

/// Throws what `fix` throws, and Cancelled between its stages.
RepairedMesh repaired(const Mesh& mesh, const Progress& progress);

/// The vertices of the problems in `report`, ascending: corners of faces, ends of edges. Leaves out
/// mere information, such as several components. Has no more vertices than the report lists.
struct FaultyVertices {
  std::vector<Index> hindering;  ///< an edit cannot include these
  std::vector<Index> others;
};
FaultyVertices faulty_vertices(const Mesh& mesh, const CheckReport& report);

/// Returns where to look for `vertices`: the finite ones and, for the others, the finite corners of
/// their faces. Ascending.
std::vector<Index> places_of(const Mesh& mesh, const FaultyVertices& vertices);

/// Returns the direction from which `places` are visible, whatever the orientation of their faces:
/// a unit vector. Returns nothing if they are on no face, or equally on opposite sides.
std::optional<Eigen::Vector3d> side_of(const Mesh& mesh, std::span<const Index> places);

}  // namespace lapwing::viewer
