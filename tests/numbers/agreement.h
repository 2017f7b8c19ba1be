#pragma once

#include <string>

#include "lapwing/base/errors.h"
#include "numbers/operations.h"

namespace lapwing::test {

/// Of the plain mesh's diagonal: what a result on the placed mesh may be off from the plain one.
/// Less than settling leaves, a ten-thousandth of an edge: on needles, rounding decides where
/// within that it ends.
inline constexpr double kAgreement = 5e-6;

/// What an operation makes of a mesh, or why it refuses to.
struct Outcome {
  Mesh mesh;
  std::string refusal;  ///< empty: there is a mesh
};

Outcome outcome_of(const Operation& operation, const Mesh& plain, const Placement& placement);

/// Where rounding has decided otherwise between two edges that remeshing could as well split,
/// collapse or flip, the triangles are others, of the same surface: it is at most this far away,
/// and the vertices are as many but for this share.
inline constexpr double kSameSurface = 2e-2;
inline constexpr double kSameCount = 0.1;

/// Whether `result` is `expected` on a mesh of that diagonal, in one of these two ways.
bool agrees(const Mesh& result, const Mesh& expected, double diagonal);

}  // namespace lapwing::test
