#pragma once

#include <memory>
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

}  // namespace lapwing::viewer
