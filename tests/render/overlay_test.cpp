#include "lapwing/render/overlay.h"

#include <gtest/gtest.h>

namespace lapwing {
namespace {

const Eigen::Vector3f kBlack = Eigen::Vector3f::Zero();

TEST(Overlay, TextStaysInItsWidth) {
  Overlay overlay;
  overlay.add_text(10.0F, 20.0F, 2.0F, kBlack, "-1.25e+08 mm");
  const float right = 10.0F + Overlay::text_width(2.0F, "-1.25e+08 mm");
  EXPECT_GT(overlay.rectangles().size(), 12U);
  for (const OverlayRectangle& rectangle : overlay.rectangles()) {
    EXPECT_GE(rectangle.corners[0], 10.0F);
    EXPECT_LE(rectangle.corners[2], right);
    EXPECT_GE(rectangle.corners[1], 20.0F);
    EXPECT_LT(rectangle.corners[0], rectangle.corners[2]);
    EXPECT_LT(rectangle.corners[1], rectangle.corners[3]);
  }
}

TEST(Overlay, CharactersWithoutALetterShowAsQuestionMarks) {
  Overlay marks;
  marks.add_text(0.0F, 0.0F, 1.0F, kBlack, "??");
  Overlay others;
  others.add_text(0.0F, 0.0F, 1.0F, kBlack, "\xC3\xA9");
  EXPECT_EQ(others.rectangles().size(), marks.rectangles().size());
}

TEST(Legend, LiesInsideThePicture) {
  for (const auto& [width, height] : {std::pair{256U, 192U}, std::pair{1280U, 960U}}) {
    const Overlay overlay = legend_overlay(
        {ColorMap::sequential, {-1.5e-6F, 2.0F}, "distance,\nmetres"}, width, height);
    for (const OverlayRectangle& rectangle : overlay.rectangles()) {
      EXPECT_GE(rectangle.corners[0], 0.0F);
      EXPECT_GE(rectangle.corners[1], 0.0F);
      EXPECT_LE(rectangle.corners[2], static_cast<float>(width));
      EXPECT_LE(rectangle.corners[3], static_cast<float>(height));
    }
  }
}

TEST(Legend, NumbersChangeWithTheRange) {
  const auto count = [](float high) {
    return legend_overlay({ColorMap::sequential, {0.0F, high}, ""}, 640, 480).rectangles().size();
  };
  EXPECT_LT(count(1.0F), count(888.0F));
}

TEST(Legend, StaysInItsShareOfThePicture) {
  for (const auto& [width, height] : {std::pair{640U, 480U}, std::pair{1280U, 960U}}) {
    const Overlay overlay = legend_overlay(
        {ColorMap::sequential, {0.0F, 0.0937F}, "displacement,\nmesh units", true}, width, height);
    const double left = width * (1.0 - legend_share(width, height));
    for (const OverlayRectangle& rectangle : overlay.rectangles()) {
      EXPECT_GE(rectangle.corners[0], left);
    }
  }
}

TEST(Legend, SaysWhereNumbersLieOutsideTheRange) {
  const auto count = [](bool more_above, bool less_below) {
    return legend_overlay({ColorMap::sequential, {0.0F, 1.0F}, "", more_above, less_below}, 640,
                          480)
        .rectangles()
        .size();
  };
  EXPECT_LT(count(false, false), count(true, false));
  EXPECT_LT(count(true, false), count(true, true));
}

}  // namespace
}  // namespace lapwing
