#include "report/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lapwing::bench {
namespace {

using ::testing::HasSubstr;

TEST(Svg, WritesShapesByClassAndToATenthOfAPixel) {
  Svg svg(100, 50);
  svg.line({1.0, 2.04}, {3.25, -0.04}, "grid");
  EXPECT_THAT(svg.element("a plot"),
              HasSubstr("<line class=\"grid\" x1=\"1\" y1=\"2\" x2=\"3.2\" y2=\"0\"/>"));
  EXPECT_THAT(svg.element("a plot"), HasSubstr("viewBox=\"0 0 100 50\""));
}

TEST(Svg, EscapesWhatTextWouldBreak) {
  Svg svg(100, 50);
  svg.text({0.0, 0.0}, "a < b & \"c\"", "ink", Anchor::end);
  svg.rectangle({0.0, 0.0}, 1.0, 1.0, "bar", "<tip>");
  const std::string text = svg.element("l'abel");
  EXPECT_THAT(text, HasSubstr("text-anchor=\"end\">a &lt; b &amp; &quot;c&quot;</text>"));
  EXPECT_THAT(text, HasSubstr("<title>&lt;tip&gt;</title></rect>"));
  EXPECT_THAT(text, HasSubstr("aria-label=\"l&#39;abel\""));
}

TEST(Svg, HoldsOtherPicturesWhereTheyArePlaced) {
  Svg inner(10, 10);
  inner.marker({1.0, 1.0}, 0, "f0");
  Svg outer(100, 50);
  outer.place(inner, {20.0, 5.0});
  EXPECT_THAT(outer.element("a plot"),
              HasSubstr("<g transform=\"translate(20 5)\">\n<path class=\"f0\""));
}

}  // namespace
}  // namespace lapwing::bench
