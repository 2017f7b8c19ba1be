#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/doctor/holes.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/region_spec.h"

namespace lapwing {

/// The shape of the surface that fills a hole.
enum class FillShape {
  flat,    ///< the triangulation of the rim with the smallest area, without new vertices
  smooth,  ///< triangles of the same size as those at the rim; the tangent planes of the surface
           ///< continue
};

/// Options for filling the holes of a mesh.
struct FillRequest {
  RegionSpec region = {AllVertices{}};  ///< holes with no rim vertex in it stay open
  FillShape shape = FillShape::smooth;
  int largest = 0;                   ///< holes with more rim vertices stay open; 0 for no limit
  bool borders = false;              ///< whether to fill the borders of open sheets
  std::string where = "fill_holes";  ///< as in RegionSpec; ignored by ==
  bool operator==(const FillRequest& other) const {
    return region == other.region && shape == other.shape && largest == other.largest &&
           borders == other.borders;
  }
};

struct FilledHoles {
  Mesh mesh;
  std::size_t holes = 0;
  std::size_t vertices = 0;           ///< number of new vertices; they follow those of the mesh
  std::size_t faces = 0;              ///< number of new triangles; they follow those of the mesh
  std::vector<std::string> warnings;  ///< holes that were requested, but cannot be filled
  std::vector<std::string> notes;     ///< attributes that the new triangles lack
};

/// Fills `holes`, which `find_holes(mesh)` returned. The vertices and faces of `mesh` stay. A flat
/// fill of a planar rim is planar. A smooth fill is refined to the mean edge length at the rim,
/// which is interpolated inside (Liepa, "Filling Holes in Meshes", 2003), and minimizes the
/// thin-plate energy (fair_patches.h). It is a little flatter than a sphere: if the rim of a hole
/// in a sphere is 20, 30 or 60 degrees from the centre of the hole, the fill deviates from the
/// sphere by at most 0.2, 0.8 or 12 % of the radius. Neither shape avoids intersections with other
/// parts. New vertices and faces get attributes as in `append_patches`; they have no texture
/// coordinates. If the mesh has an edge that is also a diagonal of the rim, the diagonal gets a new
/// vertex. The mesh is closed where a hole was filled, and a manifold mesh stays manifold.
///
/// Throws InputError, naming the hole, if it has a `trouble` or a size outside the limits of
/// `require_extent`; InputError, naming a vertex, if a face of the mesh is not finite; InputError
/// or SolverError if a fill would need too many triangles or too much memory; and Cancelled. Stage
/// "fill".
FilledHoles fill_holes(const Mesh& mesh, std::span<const Hole> holes,
                       FillShape shape = FillShape::smooth, const Progress& progress = {});

/// Fills the holes that `request` selects, except those with a `trouble`, about which it warns.
/// Throws InputError, naming `region.where`, if the region does not fit the mesh or has a size
/// outside the limits of `require_extent`, and the errors of the function above.
FilledHoles fill_holes(const Mesh& mesh, const FillRequest& request, const Progress& progress = {});

}  // namespace lapwing
