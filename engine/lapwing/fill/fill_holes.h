#pragma once

#include <cstddef>
#include <span>

#include "lapwing/base/cancellation.h"
#include "lapwing/doctor/holes.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The shape of the surface that fills a hole.
enum class FillShape {
  flat,    ///< the triangulation of the rim with the smallest area, without new vertices
  smooth,  ///< triangles of the rim's size, whose tangent planes continue those of the surface
};

struct FilledHoles {
  Mesh mesh;
  std::size_t holes = 0;
  std::size_t vertices = 0;  ///< number of new vertices; they follow those of the mesh
  std::size_t faces = 0;     ///< number of new triangles; they follow those of the mesh
};

/// Fills `holes`, which `find_holes(mesh)` returned. The vertices and faces of `mesh` stay. A flat
/// fill of a plane rim is plane. A smooth fill is refined to the mean edge length at the rim, which
/// is interpolated inside (Liepa, "Filling Holes in Meshes", 2003), and minimizes the thin-plate
/// energy (fair_patches.h). It is a little flatter than a sphere: if the rim of a hole in a sphere
/// is 20, 30 or 60 degrees from its pole, the fill is within 0.2, 0.8 or 12 % of the radius.
/// Neither shape avoids intersections with other parts. New vertices and faces get attributes as in
/// `append_patches`; they have no texture coordinates. If the mesh has an edge that is also a
/// diagonal of the rim, the diagonal gets a new vertex. Filled holes close the mesh there, and a
/// manifold mesh stays manifold.
///
/// Throws InputError, naming the hole, if it has a `trouble`; InputError or SolverError if a fill
/// would need too many triangles or too much memory; and Cancelled. Stage "fill".
FilledHoles fill_holes(const Mesh& mesh, std::span<const Hole> holes,
                       FillShape shape = FillShape::smooth, const Progress& progress = {});

}  // namespace lapwing
