#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "lapwing/render/render_image.h"
#include "lapwing/render/surface.h"

namespace lapwing::test {

/// A mesh on the device, ready to be drawn. The camera is in front of the mesh and uses an
/// orthographic projection, so that pixel coordinates are easy to compute.
class Subject {
 public:
  explicit Subject(const Mesh& subject_mesh)
      : mesh(subject_mesh),
        surface(context, mesh.positions, mesh.topology()),
        paint(surface),
        camera(fit(mesh.positions, view_axes(View::front), 1.0,
                   {.orthographic = true, .margin = kMargin})) {
    options.width = kSize;
    options.height = kSize;
  }

  Image render() { return render_image(surface, paint, camera, options); }

  /// Draws the mesh at its rest positions, translated by `distance` along x.
  void move_by(double distance) {
    Positions moved = mesh.positions;
    for (Eigen::Vector3d& p : moved) p.x() += distance;
    surface.place(moved);
  }

  static constexpr std::uint32_t kSize = 128;
  static constexpr double kMargin = 0.1;

  std::shared_ptr<gpu::Context> context = std::make_shared<gpu::Context>();
  Mesh mesh;
  Surface surface;
  SurfacePaint paint;
  Camera camera;
  RenderOptions options;
};

/// Returns the fraction of the image that is not transparent.
inline double coverage(const Image& image) {
  double sum = 0.0;
  for (std::size_t at = 3; at < image.rgba.size(); at += 4) sum += image.rgba[at];
  return sum / (255.0 * image.width * image.height);
}

/// Returns the mean difference of the channels, from 0 to 255, of two images of equal size.
inline double mean_difference(const Image& a, const Image& b) {
  double sum = 0.0;
  for (std::size_t at = 0; at < a.rgba.size(); ++at) sum += std::abs(a.rgba[at] - b.rgba[at]);
  return sum / static_cast<double>(a.rgba.size());
}

inline int brightness(const Image& image, std::uint32_t x, std::uint32_t y) {
  const auto p = image.pixel(x, y);
  return p[0] + p[1] + p[2];
}

}  // namespace lapwing::test
