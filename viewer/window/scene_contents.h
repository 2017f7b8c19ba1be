#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "window/app.h"

namespace lapwing::viewer {

/// All that a picture of a scene shows, as a value: a picture that is kept stands for every scene
/// of equal contents. These are the surfaces, what is carried and their colours (by revision), the
/// cameras, the styles, the background, and where the second surface stands.
///
/// How well it is drawn is no part of it: neither `Scene::moving` nor `SurfaceStyle::sides`, which
/// leaves out only what does not show. Neither are panels, nor the marks of tools, which ImGui
/// draws over the picture.
class SceneContents {
 public:
  /// Those of `scene`. Allocates nothing where as much is carried as before.
  void take(const Scene& scene);

  bool operator==(const SceneContents&) const = default;
  /// Whether what there is looks alike, but is seen from elsewhere.
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
