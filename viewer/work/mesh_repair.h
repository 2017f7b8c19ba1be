#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing::viewer {

/// A mesh as `fix` leaves it, ready to be shown.
struct RepairedMesh {
  std::shared_ptr<const Mesh> mesh;
  FixReport done;
  CheckReport left;  ///< what is still wrong
};

/// Throws what `fix` does, and Cancelled between its stages.
RepairedMesh repaired(const Mesh& mesh, const Progress& progress);

/// The vertices that the problems of `report` are about, ascending: corners of faces, ends of
/// edges. What is no problem, as that there are several components, is left out. As many as the
/// report lists.
struct FaultyVertices {
  std::vector<Index> hindering;  ///< an edit cannot include these
  std::vector<Index> others;
};
FaultyVertices faulty_vertices(const Mesh& mesh, const CheckReport& report);

/// Where to look for `vertices`: those that are finite, and for the others the finite corners of
/// their faces. Ascending.
std::vector<Index> places_of(const Mesh& mesh, const FaultyVertices& vertices);

/// From which side `places` show, whichever way their faces are turned: a unit vector. Nothing
/// where they are on no face, or about as many on opposite sides.
std::optional<Eigen::Vector3d> side_of(const Mesh& mesh, std::span<const Index> places);

}  // namespace lapwing::viewer
