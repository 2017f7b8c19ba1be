#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/modifiers/mirror.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/targets.h"

namespace lapwing {

/// The plane of symmetry of a template and the mirror image of each of its vertices.
class TemplateMirror {
 public:
  /// Throws InputError, naming `spec.where` and a vertex, unless the vertices form pairs of mirror
  /// images: each image is within a quarter of the mean edge length of the mirrored vertex. Also
  /// throws the errors of `find_mirror_plane` and `mirror_images`. O(n log n).
  TemplateMirror(const Mesh& wrapped, const MirrorSpec& spec);

  /// Moves the plane by a similarity transformation, such as the alignment of the template.
  void transform(const Eigen::Affine3d& similarity);
  const MirrorPlane& plane() const { return plane_; }

  /// Replaces the pose by the mean of the pose and its mirror image, which is exactly symmetric.
  /// Vertices without triangles do not move.
  void make_symmetric(Positions& pose) const;

  /// Returns the mirror images of targets of a symmetric pose of the template.
  std::vector<Target> images_of(std::span<const Target> targets, const VertexSet& roi,
                                const Mesh& pose) const;

 private:
  MirrorPlane plane_;
  std::vector<Index> images_;  // kNoIndex for a vertex without triangles
};

}  // namespace lapwing
