#pragma once

#include <optional>

#include "lapwing/deform/modifiers/mirror.h"

namespace lapwing::viewer {

/// The symmetry planes that the panels offer: none, three planes through the origin, and the plane
/// that is found from the shape.
enum class MirrorChoice { off, x, y, z, shape };

/// Returns the axis whose plane through the origin this is, if it is one of them.
std::optional<MirrorChoice> choice_of(const MirrorPlane& plane);
/// Returns the plane of an axis; none for the other choices.
std::optional<MirrorPlane> plane_of(MirrorChoice choice);

/// Draws the choices; none is marked if `choice` is empty. Sets `choice` to the one that is
/// clicked, and returns whether one was.
bool choose_mirror(std::optional<MirrorChoice>& choice);

}  // namespace lapwing::viewer
