#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "window/app.h"

namespace lapwing::viewer {

/// What a picture of a scene depends on, as a value. A kept picture serves every scene with equal
/// contents: surfaces, carried objects and their colours (by revision), cameras, styles,
/// background, and the place of the second surface.
///
/// Quality is not part of it: neither `Scene::moving` nor `SurfaceStyle::sides`, which omits only
/// what does not show. Nor are panels and the marks of tools, which ImGui draws over the picture.
class SceneContents {
 public:
  /// Takes the contents of `scene`. Allocates nothing if as much is carried as before.
  void take(const Scene& scene);

  bool operator==(const SceneContents&) const = default;
  /// Whether only the cameras differ.
  bool differs_in_view_alone(const SceneContents& other) const;

 private:
  struct Seen {
    std::uint64_t surface = 0;
    std::uint64_t paint = 0;
    Camera camera;
    SurfaceStyle style;

    bool operator==(const Seen&) const = default;
  };
  static Seen seen(const SurfaceScene& scene);

  Seen main_;
  std::vector<std::uint64_t> carried_;
  std::optional<Seen> beside_;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d size_ = Eigen::Vector2d::Zero();
  Background background_ = Background::gradient;
};

}  // namespace lapwing::viewer
