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

/// A mesh repaired by `fix`, with its topology computed.
struct RepairedMesh {
  std::shared_ptr<const Mesh> mesh;
  FixReport done;
  CheckReport left;  ///< the remaining defects
};

/// Returns a repaired copy of `mesh`. Throws the errors of `fix`. Throws Cancelled if `progress`
/// cancels between two stages.
RepairedMesh repaired(const Mesh& mesh, const Progress& progress);

/// The vertices of the defects that a report lists, ascending, including the corners of faces and
/// the ends of edges. Entries of severity `info`, such as several components, are omitted.
struct FaultyVertices {
  std::vector<Index> hindering;  ///< vertices of errors; a region cannot include them
  std::vector<Index> others;     ///< vertices of warnings
};
FaultyVertices faulty_vertices(const Mesh& mesh, const CheckReport& report);

/// Returns the vertices that show where the defects are, ascending. A vertex with a non-finite
/// position is replaced by the finite corners of its faces.
std::vector<Index> places_of(const Mesh& mesh, const FaultyVertices& vertices);

/// Returns the unit direction in which the surface at `places` faces outward from the centre of the
/// mesh, independent of the orientation of the faces. Returns nullopt if no face contains a place,
/// or if the places face different directions.
std::optional<Eigen::Vector3d> side_of(const Mesh& mesh, std::span<const Index> places);

}  // namespace lapwing::viewer
