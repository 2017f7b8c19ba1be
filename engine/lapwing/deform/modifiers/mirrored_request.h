#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lapwing/deform/deform_request.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Returns the move of the mirror image of a handle that moves by `move`.
Move mirror_image(const Move& move, const MirrorPlane& plane);

/// Returns the symmetric part of `move`, for a handle that lies across the plane. This consists of
/// the translation along the plane and the turn about its normal. For a matrix, it is the mean of
/// the matrix and its mirror image.
Move along_mirror(const Move& move, const MirrorPlane& plane);

/// A request without a mirror that is equivalent to one with a mirror.
struct MirroredRequest {
  DeformRequest request;
  /// For each handle of `request`, the index of its image, or its own index if it is merged with
  /// its image. The original handles come first, then the images. The list is empty without a
  /// mirror.
  std::vector<std::size_t> handle_images;
  std::optional<MirrorPlane> plane;  ///< given by the user or found from the shape
  std::vector<std::string> notes;    ///< for the user, about the plane and the symmetry of the mesh
};

/// Adds the mirror images of ROI, belt, handles and targets (`mirror_images`). A handle that shares
/// a vertex with its image is merged with the image and moves `along_mirror`; so does a target that
/// is its own image. Regions become vertex lists, and falloffs become one weight per vertex. Both
/// are exactly symmetric on a symmetric mesh. Vertices in the plane between a falloff and its image
/// are free. Throws the errors of `mirror_images` and `resolve_edit_region`. Also throws InputError
/// if the image of a handle contains vertices of another handle.
MirroredRequest mirrored_request(const DeformRequest& request, const Mesh& mesh);

}  // namespace lapwing
