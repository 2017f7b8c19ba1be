#include "lapwing/wrap/template_mirror.h"

#include <sstream>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr double kFarthestImage = 0.25;  // of the mean edge length

[[noreturn]] void refuse(const MirrorSpec& spec, Index v, double distance, double farthest) {
  std::ostringstream text;
  text << spec.where << ": vertex " << v << " of the template has no mirror image. ";
  if (distance > farthest) {
    text << "The nearest vertex is " << distance
         << " away from its mirrored position, but must be within " << farthest
         << ", a quarter of the mean edge length. ";
  } else {
    text << "The vertex nearest to its mirrored position is the image of another vertex. ";
  }
  text << "Give the plane of symmetry, make the template symmetric, or remove \"mirror\"";
  throw InputError(text.str(), {v});
}

MirrorPlane plane_of(const Mesh& mesh, const MirrorSpec& spec) {
  const auto* plane = std::get_if<MirrorPlane>(&spec.plane);
  return plane != nullptr ? *plane : find_mirror_plane(mesh, spec.where).plane;
}

}  // namespace

TemplateMirror::TemplateMirror(const Mesh& wrapped, const MirrorSpec& spec)
    : plane_(plane_of(wrapped, spec)), images_(mirror_images(wrapped, plane_, spec.where)) {
  const Adjacency& rings = wrapped.topology().rings;
  const double farthest = kFarthestImage * mean_edge_length(rings, wrapped.positions);
  const Eigen::Affine3d mirror = reflection(plane_);
  for (Index v = 0; v < images_.size(); ++v) {
    if (rings.size(v) == 0) {
      images_[v] = kNoIndex;
      continue;
    }
    const double distance = (mirror * wrapped.positions[v] - wrapped.positions[images_[v]]).norm();
    if (!(distance <= farthest) || images_[images_[v]] != v) refuse(spec, v, distance, farthest);
  }
}

void TemplateMirror::transform(const Eigen::Affine3d& similarity) {
  plane_.point = similarity * plane_.point;
  plane_.normal = similarity.linear() * plane_.normal;
}

void TemplateMirror::make_symmetric(Positions& pose) const {
  const Eigen::Affine3d mirror = reflection(plane_);
  for (Index v = 0; v < images_.size(); ++v) {
    const Index image = images_[v];
    if (image == kNoIndex || image < v) continue;
    const Vector3d mean = 0.5 * (pose[v] + mirror * pose[image]);
    pose[v] = mean;
    if (image != v) pose[image] = mirror * mean;
  }
}

std::vector<Target> TemplateMirror::images_of(std::span<const Target> targets, const VertexSet& roi,
                                              const Mesh& pose) const {
  const Eigen::Affine3d mirror = reflection(plane_);
  TargetSpec images;
  for (std::size_t r = 0; r < targets.size(); ++r) {
    images.rows.push_back({mirror * point_of(targets[r], pose.positions),
                           mirror * targets[r].position, targets[r].weight, r});
  }
  return resolve_targets(images, roi, {}, pose);
}

}  // namespace lapwing
