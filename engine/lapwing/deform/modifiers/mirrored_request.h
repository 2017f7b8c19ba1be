#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lapwing/deform/deform_request.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The move of the mirror image of a handle that moves by `move`.
Move mirror_image(const Move& move, const MirrorPlane& plane);

/// The part of `move` that is its own mirror image, for a handle that lies across the plane: of a
/// translation what is along the plane, of a turn what is about its normal; of a matrix the mean
/// with its image.
Move along_mirror(const Move& move, const MirrorPlane& plane);

/// A request without a mirror that does what one with it asks for.
struct MirroredRequest {
  DeformRequest request;
  /// Of each of its handles, the number of its image there; its own where it lies across the plane.
  /// Those of the request come first, then the images. Empty without a mirror.
  std::vector<std::size_t> handle_images;
  std::optional<MirrorPlane> plane;  ///< given or found
  std::vector<std::string> notes;    ///< for a person: which plane, how symmetric the mesh is
};

/// ROI, belt, handles and targets, each with its image. A handle that shares a vertex with its
/// image becomes one with it and moves `along_mirror`; likewise a target that is its own image. The
/// images of vertices are `mirror_images`. Regions, a belt by fraction too, become lists, falloffs
/// become fields: on a symmetric mesh they are symmetric to the last vertex. Between a falloff and
/// its image the vertices in the plane are free. Throws InputError as `mirror_images` and
/// `resolve_edit_region` do, and for a handle whose image takes vertices of another handle.
MirroredRequest mirrored_request(const DeformRequest& request, const Mesh& mesh);

}  // namespace lapwing
