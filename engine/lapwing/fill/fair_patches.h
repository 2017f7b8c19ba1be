#pragma once

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Moves the vertices of `surface` from `first` on so that they minimize the thin-plate energy
///     sum_i m_i |(D x)_i|^2
/// over these vertices and their neighbours, where D is the cotangent Laplace operator of the given
/// positions and m_i the area of vertex i. All other vertices are held. The energy includes the
/// rings of the neighbours, so that tangent planes are continuous there. Factorizes an n x n
/// system. Every component of the moved vertices must touch a held one.
void fair_patches(Mesh& surface, Index first);

}  // namespace lapwing
