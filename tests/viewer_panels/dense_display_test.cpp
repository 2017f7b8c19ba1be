// The viewer on a display of twice the density: the same picture in four times as many pixels.
#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/gpu.h"
#include "support/keep_picture.h"
#include "viewer_panels/shown_viewer.h"

namespace lapwing::viewer::test {
namespace {

using Eigen::Vector2d;

constexpr std::uint32_t kDensity = 2;
constexpr VkExtent2D kSizePt{1280, 800};

// Of each channel, from 0 to 255: more than antialiasing makes.
constexpr int kVisible = 60;

/// As many pixels in a row and column made one, their mean.
Image coarser(const Image& fine, std::uint32_t by) {
  Image image{fine.width / by, fine.height / by, {}};
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      std::array<std::uint32_t, 4> sum{};
      for (std::uint32_t k = 0; k < by * by; ++k) {
        const auto pixel = fine.pixel(by * x + k % by, by * y + k / by);
        for (std::size_t c = 0; c < 4; ++c) sum[c] += pixel[c];
      }
      for (const std::uint32_t each : sum) {
        image.rgba.push_back(static_cast<std::uint8_t>(each / (by * by)));
      }
    }
  }
  return image;
}

/// How many pixels of what the panels leave free are visibly others: the rasters of small letters
/// are.
int difference(const Image& a, const Image& b) {
  constexpr std::uint32_t kLeft = 400;
  constexpr std::uint32_t kTop = 60;
  constexpr std::uint32_t kBottom = 700;
  int others = 0;
  for (std::uint32_t y = kTop; y < kBottom; ++y) {
    for (std::uint32_t x = kLeft; x < a.width; ++x) {
      const auto p = a.pixel(x, y);
      const auto q = b.pixel(x, y);
      bool differs = false;
      for (std::size_t c = 0; c < 3; ++c) differs = differs || std::abs(p[c] - q[c]) > kVisible;
      if (differs) ++others;
    }
  }
  return others;
}

class ADenseViewer : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    context_ = std::make_shared<gpu::Context>();
  }

  std::unique_ptr<ShownViewer> viewer(std::uint32_t density) const {
    auto viewer = std::make_unique<ShownViewer>(
        context_, Look{Theme::dark,
                       {density * kSizePt.width, density * kSizePt.height},
                       static_cast<double>(density)});
    write_mesh(rippled_cylinder(24, 41), viewer->folder() / "tube.obj");
    return viewer;
  }

  // The picture after `act`, on a plain display and, made coarser, on a dense one.
  void expect_same(const std::string& name,
                   const std::function<void(ShownViewer&, double density)>& act) const {
    std::array<Image, 2> pictures;
    for (const std::uint32_t density : {std::uint32_t{1}, kDensity}) {
      const auto shown = viewer(density);
      act(*shown, density);
      const Image picture = shown->picture();
      lapwing::test::keep_picture(picture, name + "-" + std::to_string(density));
      pictures[density == 1 ? 0 : 1] = coarser(picture, density);
    }
    EXPECT_LE(difference(pictures[0], pictures[1]), kMost) << name;
  }

  // A gizmo, a dot or a brush of another size makes more.
  static constexpr int kMost = 150;

  std::shared_ptr<gpu::Context> context_;
};

void point_at(ShownViewer& viewer, const Vector2d& pixel) {
  viewer.app().handle({.kind = InputKind::move, .position = pixel});
}

TEST_F(ADenseViewer, ShowsTheGizmoAndThePinsAsLarge) {
  expect_same("gizmo", [](ShownViewer& viewer, double) {
    std::ofstream(viewer.folder() / "bend.json") << R"({"lapwing": 1, "mesh": "tube.obj", "steps": [
      {"op": "deform", "roi": {"all": true},
       "belt": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.6]}},
       "handles": [{"region": {"vertices": [500]}, "move": {"translate": [0.1, 0, 0]}},
                   {"region": {"box": {"min": [-1, -1, 5.4], "max": [1, 1, 7]}},
                    "move": {"translate": [2, 0, 0]}}]}]})";
    viewer.open(viewer.folder() / "bend.json");
    viewer.wait_for([&] { return viewer.says("Ready: refines while dragging"); },
                    "the edit is prepared");
  });
}

TEST_F(ADenseViewer, ShowsTheBrushAndTheWireframeAsLarge) {
  expect_same("brush", [](ShownViewer& viewer, double density) {
    viewer.open(viewer.folder() / "tube.obj");
    viewer.key('P');
    viewer.key('Z', {.shift = true});
    point_at(viewer, density * Vector2d(820.0, 430.0));
  });
}

TEST_F(ADenseViewer, ShowsADiskAndARulerAsLarge) {
  expect_same("disk", [](ShownViewer& viewer, double density) {
    viewer.open(viewer.folder() / "tube.obj");
    const Vector2d middle = density * Vector2d(820.0, 400.0);
    viewer.key('I');
    viewer.key('D');
    viewer.drag(middle, middle + density * Vector2d(0.0, 60.0));
    viewer.key('U');
    viewer.drag(middle, middle + density * Vector2d(150.0, -70.0));
    viewer.wait_for([&] { return viewer.says("along the surface"); }, "it is measured");
  });
}

TEST_F(ADenseViewer, IsClickedByAHandThatShakesAsMuch) {
  for (const std::uint32_t density : {std::uint32_t{1}, kDensity}) {
    for (const auto& [way_pt, clicks] : {std::pair{2.5, true}, std::pair{3.5, false}}) {
      const auto shown = viewer(density);
      shown->open(shown->folder() / "tube.obj");
      shown->key('M');
      const Vector2d middle = density * Vector2d(820.0, 400.0);
      shown->drag(middle, middle + density * Vector2d(way_pt, 0.0));
      EXPECT_EQ(shown->says("Vertex "), clicks) << density << " pixels a point, " << way_pt;
    }
  }
}

}  // namespace
}  // namespace lapwing::viewer::test
