#pragma once

#include <algorithm>
#include <cmath>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "viewer_window/window_test.h"

namespace lapwing {

/// A ball with a face twice and vertices without a face.
inline Mesh broken_ball() {
  Mesh mesh = icosphere(3);
  const std::vector<Index> corners(mesh.face(100).begin(), mesh.face(100).end());
  mesh.add_face(corners);
  for (int k = 0; k < 12; ++k) mesh.positions.emplace_back(1.4, 0.1 * k, 0.0);
  return mesh;
}

/// The banner over the picture.
class Doctor : public test::WindowTest {
 protected:
  Image open_named(const std::filesystem::path& mesh) {
    person_->open(mesh);
    EXPECT_TRUE(person_->waits_for_window()) << person_->errors();
    EXPECT_TRUE(is_open(mesh.filename()));
    return desktop_->settled_picture();
  }

  // The last line of the banner that is in the colour of problems: its left end.
  static std::optional<Eigen::Vector2d> problem_in(const Image& image) {
    std::optional<Eigen::Vector2d> found;
    constexpr std::uint32_t kSidebar = 380;
    for (std::uint32_t y = 0; y < image.height; ++y) {
      for (std::uint32_t x = kSidebar; x < image.width; ++x) {
        const auto pixel = image.pixel(x, y);
        if (std::abs(pixel[0] - 242) > 4 || std::abs(pixel[1] - 194) > 4 ||
            std::abs(pixel[2] - 77) > 4) {
          continue;
        }
        const double left = found ? std::min(found->x(), 1.0 * x) : x;
        found = Eigen::Vector2d(left, y);
      }
    }
    return found;
  }

  // Waits for it.
  std::optional<Eigen::Vector2d> problem() const {
    std::optional<Eigen::Vector2d> found;
    test::eventually(kPatienceSeconds,
                     [&] { return (found = problem_in(desktop_->picture())).has_value(); });
    return found ? problem_in(desktop_->settled_picture()) : found;
  }

  // The buttons are below the line that follows.
  Image press(const Eigen::Vector2d& problem, double right) {
    const Image before = desktop_->settled_picture();
    person_->click(problem + Eigen::Vector2d(right, 42.0));
    EXPECT_TRUE(differs_from(before, 0.2));
    return desktop_->settled_picture();
  }

  // Of the preview that is shown, whose buttons are one line lower or so: the first that opens the
  // browser.
  void press_keep(const Eigen::Vector2d& problem, const Image& preview) {
    bool asks = false;
    for (double down = 42.0; down < 90.0 && !asks; down += 6.0) {
      person_->click(problem + Eigen::Vector2d(kFirst, down));
      asks = test::mean_difference(desktop_->settled_picture(), preview) > 5.0;
    }
    ASSERT_TRUE(asks);
  }

  static constexpr double kFirst = 18.0;
  static constexpr double kSecond = 80.0;
  static constexpr double kThird = 145.0;
};

}  // namespace lapwing
