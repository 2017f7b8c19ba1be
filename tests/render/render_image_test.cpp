#include "lapwing/render/render_image.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "render/picture.h"
#include "support/gpu.h"
#include "support/keep_picture.h"

namespace lapwing {
namespace {

using test::brightness;
using test::coverage;
using test::mean_difference;
using test::Subject;

constexpr std::uint32_t kMiddle = Subject::kSize / 2;
constexpr std::uint32_t kLast = Subject::kSize - 1;
constexpr double kPartShown = 1.0 - 2.0 * Subject::kMargin;

Mesh quads(Index columns, Index rows) {
  Mesh mesh;
  mesh.positions = grid(columns, rows).positions;
  for (Index r = 0; r < rows; ++r) {
    for (Index c = 0; c < columns; ++c) {
      const Index first = r * (columns + 1) + c;
      mesh.add_face(
          std::array<Index, 4>{first, first + 1, first + columns + 2, first + columns + 1});
    }
  }
  return mesh;
}

// Returns the column of the image at which the coordinate x of the unit square is drawn.
std::uint32_t column(double x) {
  return static_cast<std::uint32_t>((0.5 + (x - 0.5) * kPartShown) * Subject::kSize);
}

double mean_column(const Image& image) {
  double sum = 0.0;
  double weight = 0.0;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      sum += image.pixel(x, y)[3] * (x + 0.5);
      weight += image.pixel(x, y)[3];
    }
  }
  return sum / weight;
}

TEST(RenderImage, SphereIsALitDiscOnTheBackground) {
  LAPWING_NEEDS_GPU();
  Subject sphere(icosphere(4));
  const Image image = sphere.render();
  EXPECT_GT(brightness(image, kMiddle, kMiddle), 300);
  sphere.options.background = Background::transparent;
  const Image cut_out = sphere.render();
  EXPECT_NEAR(coverage(cut_out), std::numbers::pi / 4.0 * kPartShown * kPartShown,
              0.02 * std::numbers::pi / 4.0);
  for (const auto& [x, y] : {std::pair{0U, 0U}, {kLast, 0U}, {0U, kLast}, {kLast, kLast}}) {
    EXPECT_EQ(cut_out.pixel(x, y)[3], 0);
    EXPECT_GT(brightness(image, x, y), 550);
  }
}

// With several samples, the shaders encode colours on a software device; with one, the device does.
TEST(RenderImage, ColoursAreThoseWithoutAntialiasing) {
  LAPWING_NEEDS_GPU();
  Subject square(grid(1, 1));
  square.options.style.color = SurfaceColor::scalar;
  square.paint.set_scalars(std::vector<float>{0.0F, 1.0F, 2.0F, 3.0F});
  square.options.legend = true;
  const Image with = square.render();
  square.options.samples = 1;
  const Image without = square.render();
  std::size_t alike = 0;
  for (std::size_t at = 0; at < with.rgba.size(); ++at) {
    if (std::abs(with.rgba[at] - without.rgba[at]) <= 1) ++alike;
  }
  // Only pixels on edges may differ.
  EXPECT_GT(static_cast<double>(alike), 0.97 * static_cast<double>(with.rgba.size()));
}

TEST(RenderImage, PictureIsUpright) {
  LAPWING_NEEDS_GPU();
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.add_face(std::array<Index, 3>{0, 1, 2});
  Subject triangle(mesh);
  triangle.options.background = Background::transparent;
  const Image image = triangle.render();
  EXPECT_EQ(image.pixel(column(0.1), column(0.8))[3], 255);
  EXPECT_EQ(image.pixel(column(0.9), column(0.95))[3], 255);
  EXPECT_EQ(image.pixel(column(0.9), column(0.2))[3], 0);
}

TEST(RenderImage, WhiteBackgroundIsWhite) {
  LAPWING_NEEDS_GPU();
  Subject sphere(icosphere(1));
  sphere.options.background = Background::white;
  EXPECT_THAT(sphere.render().pixel(0, 0), ::testing::Each(255));
}

TEST(RenderImage, NearerSurfaceHidesTheFartherOne) {
  LAPWING_NEEDS_GPU();
  // The mesh is two unit squares, one behind the other.
  Mesh mesh = grid(1, 1);
  const Mesh behind = mesh;
  for (const Eigen::Vector3d& p : behind.positions) {
    mesh.positions.emplace_back(p - Eigen::Vector3d::UnitZ());
  }
  for (std::size_t f = 0; f < behind.face_count(); ++f) {
    const auto face = behind.face(f);
    mesh.add_face(std::array<Index, 3>{face[0] + 4, face[1] + 4, face[2] + 4});
  }
  Subject squares(mesh);
  std::vector<VertexClass> classes(4, VertexClass::handle);
  classes.resize(8, VertexClass::belt);
  squares.paint.set_classes(classes);
  squares.options.style.color = SurfaceColor::regions;
  const auto [r, g, b, a] = squares.render().pixel(kMiddle, kMiddle);
  EXPECT_GT(2 * g, r);  // yellow, not red
  EXPECT_GT(g, b);
}

TEST(RenderImage, WhatAHandleDrawsHasMoreOfItsColourTheMoreItDoes) {
  LAPWING_NEEDS_GPU();
  Subject square(grid(1, 1));
  square.options.style.color = SurfaceColor::regions;
  const auto blue_with = [&](VertexClass as) {
    square.paint.set_classes(std::vector<VertexClass>(4, as));
    return square.render().pixel(kMiddle, kMiddle)[2];
  };
  const auto none = blue_with(VertexClass::roi);
  const auto half = blue_with(drawn_by_handle(VertexClass::roi, 0.5));
  const auto all = blue_with(drawn_by_handle(VertexClass::roi, 1.0));
  EXPECT_GT(none, half + 20);
  EXPECT_GT(half, all + 20);
  EXPECT_EQ(all, blue_with(VertexClass::handle));
}

TEST(RenderImage, BackFacesAreDarker) {
  LAPWING_NEEDS_GPU();
  Mesh reversed = icosphere(3);
  for (std::size_t at = 0; at < reversed.face_vertices().size(); at += 3) {
    std::swap(reversed.edit_faces().vertices[at], reversed.edit_faces().vertices[at + 1]);
  }
  const Image inside = Subject(reversed).render();
  const Image outside = Subject(icosphere(3)).render();
  EXPECT_LT(brightness(inside, kMiddle, kMiddle), brightness(outside, kMiddle, kMiddle) - 100);
}

TEST(RenderImage, FrontsAloneLeaveTheBackOfASheetOut) {
  LAPWING_NEEDS_GPU();
  Subject sheet(grid(2, 2));
  sheet.options.background = Background::transparent;
  sheet.options.style.sides = Sides::front;
  EXPECT_GT(coverage(sheet.render()), 0.5);
  sheet.camera = fit(sheet.mesh.positions, view_axes(View::back), 1.0, {.orthographic = true});
  EXPECT_EQ(coverage(sheet.render()), 0.0);
}

TEST(RenderImage, FrontsAloneOfAClosedSurfaceAreTheSamePicture) {
  LAPWING_NEEDS_GPU();
  Subject ring(torus(48, 24, 1.0, 0.4));
  const Image both = ring.render();
  ring.options.style.sides = Sides::front;
  EXPECT_LT(mean_difference(ring.render(), both), 0.05);
}

TEST(RenderImage, RegionsHaveTheirColorsWithCrispBorders) {
  LAPWING_NEEDS_GPU();
  Subject square(grid(7, 1));
  std::vector<VertexClass> classes;
  for (const Eigen::Vector3d& p : square.mesh.positions) {
    classes.push_back(static_cast<VertexClass>(std::floor(std::min(p.x(), 0.999) * 4.0)));
  }
  square.paint.set_classes(classes);
  square.options.style.color = SurfaceColor::regions;
  const Image image = square.render();
  const auto outside = image.pixel(column(0.05), kMiddle);
  EXPECT_LT(std::abs(outside[0] - outside[2]), 25);
  const auto roi = image.pixel(column(0.35), kMiddle);
  EXPECT_GT(roi[2], roi[0] + 25);
  const auto belt = image.pixel(column(0.6), kMiddle);
  EXPECT_GT(belt[0], 2 * belt[1]);
  EXPECT_GT(belt[0], 2 * belt[2]);
  const auto handle = image.pixel(column(0.95), kMiddle);
  EXPECT_GT(handle[1], 1.5 * handle[2]);
  EXPECT_GT(handle[0], 1.5 * handle[2]);
  std::set<std::array<std::uint8_t, 4>> colors;
  for (std::uint32_t x = column(0.02); x < column(0.98); ++x)
    colors.insert(image.pixel(x, kMiddle));
  EXPECT_LE(colors.size(), 4U + 2U * 3U) << "four colours, at most two pixels between neighbours";
}

TEST(RenderImage, WireframeShowsPolygonEdgesAndNoDiagonals) {
  LAPWING_NEEDS_GPU();
  Subject square(quads(2, 2));
  square.paint.set_polygons(square.mesh);
  const Image plain = square.render();
  square.options.style.wireframe = true;
  const Image wire = square.render();
  for (const double y : {0.1, 0.3, 0.7, 0.9}) {
    EXPECT_LT(brightness(wire, kMiddle, column(y)), brightness(plain, kMiddle, column(y)) - 60);
  }
  for (const double at : {0.1, 0.25, 0.4}) {  // along and across both diagonals of one quad
    EXPECT_EQ(wire.pixel(column(at), column(at)), plain.pixel(column(at), column(at)));
    EXPECT_EQ(wire.pixel(column(at), column(0.5 - at)), plain.pixel(column(at), column(0.5 - at)));
  }
}

// A small sphere inside a large one.
TEST(RenderImage, AnXraySurfaceShowsWhatIsBehindIt) {
  LAPWING_NEEDS_GPU();
  const Mesh outer = icosphere(4);
  Mesh both = outer;
  for (const Eigen::Vector3d& p : outer.positions) both.positions.emplace_back(0.4 * p);
  const auto first = static_cast<Index>(outer.vertex_count());
  for (std::size_t f = 0; f < outer.face_count(); ++f) {
    const auto face = outer.face(f);
    both.add_face(std::array<Index, 3>{face[0] + first, face[1] + first, face[2] + first});
  }
  Subject hollow(outer);
  Subject filled(both);
  EXPECT_LT(mean_difference(hollow.render(), filled.render()), 1e-3);
  for (Subject* subject : {&hollow, &filled}) {
    subject->options.style.xray = true;
    subject->options.background = Background::transparent;
  }
  const Image seen = filled.render();
  test::keep_picture(seen, "xray");
  EXPECT_GT(mean_difference(hollow.render(), seen), 1.0);
  EXPECT_LT(hollow.render().pixel(kMiddle, kMiddle)[3], 200) << "the background shows through";
}

TEST(RenderImage, EveryMatcapLooksDifferentAndFollowsTheCamera) {
  LAPWING_NEEDS_GPU();
  std::set<std::vector<std::uint8_t>> pictures;
  for (const char* name : {"none", "clay", "metal", "pearl"}) {
    Subject sphere(icosphere(5));
    sphere.options.style.matcap = matcap_named(name);
    const Image front = sphere.render();
    test::keep_picture(front, std::string("matcap-") + name);
    EXPECT_TRUE(pictures.insert(front.rgba).second) << name;
    sphere.camera = fit(sphere.mesh.positions, view_axes(View::left), 1.0,
                        {.orthographic = true, .margin = Subject::kMargin});
    EXPECT_LT(mean_difference(sphere.render(), front), 1.5) << name;
  }
}

TEST(RenderImage, AnUnknownMatcapIsRefusedWithAllNames) {
  try {
    matcap_named("gold");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "unknown matcap \"gold\"; choose one of none, clay, metal, pearl");
  }
}

TEST(RenderImage, FlatShadingHasOneColorPerTriangle) {
  LAPWING_NEEDS_GPU();
  Subject sphere(icosphere(1));
  const auto colors_of_middle = [&] {
    const Image image = sphere.render();
    std::set<std::array<std::uint8_t, 4>> colors;
    for (std::uint32_t y = kMiddle - 20; y < kMiddle + 20; ++y) {
      for (std::uint32_t x = kMiddle - 20; x < kMiddle + 20; ++x) colors.insert(image.pixel(x, y));
    }
    return colors.size();
  };
  const std::size_t smooth = colors_of_middle();
  sphere.options.style.flat = true;
  EXPECT_LT(4 * colors_of_middle(), smooth);
}

TEST(RenderImage, SharpEdgesAreDrawnSharp) {
  LAPWING_NEEDS_GPU();
  Mesh roof = grid(2, 1);
  for (Eigen::Vector3d& p : roof.positions) p.z() = -std::abs(p.x() - 0.5);
  const Image image = Subject(roof).render();
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_NEAR(brightness(image, column(0.5 + 0.05 * sign), kMiddle),
                brightness(image, column(0.5 + 0.35 * sign), kMiddle), 6);
  }
  EXPECT_GT(brightness(image, column(0.45), kMiddle),
            brightness(image, column(0.55), kMiddle) + 60);
}

TEST(RenderImage, NumbersGoThroughTheColorMap) {
  LAPWING_NEEDS_GPU();
  Subject square(grid(8, 1));
  std::vector<float> numbers;
  for (const Eigen::Vector3d& p : square.mesh.positions) {
    numbers.push_back(static_cast<float>(p.x()));
  }
  square.paint.set_scalars(numbers);
  square.options.style.color = SurfaceColor::scalar;
  square.options.legend = false;
  const Image sequential = square.render();
  const auto low = sequential.pixel(column(0.05), kMiddle);
  const auto high = sequential.pixel(column(0.95), kMiddle);
  EXPECT_GT(low[2], 2 * low[1]);      // violet
  EXPECT_GT(high[1], 1.5 * high[2]);  // yellow

  square.options.style.color_map = ColorMap::diverging;
  square.options.style.range = ScalarRange{0.0F, 1.0F};
  const Image diverging = square.render();
  EXPECT_GT(diverging.pixel(column(0.05), kMiddle)[2], diverging.pixel(column(0.05), kMiddle)[0]);
  EXPECT_GT(diverging.pixel(column(0.95), kMiddle)[0], diverging.pixel(column(0.95), kMiddle)[2]);
}

TEST(RenderImage, NumbersThatAreNotFiniteAreGrey) {
  LAPWING_NEEDS_GPU();
  Subject square(grid(1, 1));
  square.paint.set_scalars(std::vector<float>(4, std::numeric_limits<float>::quiet_NaN()));
  square.options.style.color = SurfaceColor::scalar;
  const auto pixel = square.render().pixel(kMiddle, kMiddle);
  EXPECT_LT(std::abs(pixel[0] - pixel[2]), 25);
}

TEST(RenderImage, LegendShowsTheColorMapBesideTheSurface) {
  LAPWING_NEEDS_GPU();
  Subject sphere(icosphere(2));
  sphere.options.style.color = SurfaceColor::scalar;
  const Image with = sphere.render();
  sphere.options.legend = false;
  const Image without = sphere.render();
  const std::uint32_t bar = Subject::kSize - 17;
  const auto top = with.pixel(bar, kMiddle - 24);
  const auto bottom = with.pixel(bar, kMiddle + 24);
  EXPECT_GT(top[0], 1.5 * top[2]);      // yellow
  EXPECT_GT(bottom[2], 2 * bottom[1]);  // violet
  for (std::uint32_t y = 0; y < Subject::kSize; ++y) {
    EXPECT_EQ(with.pixel(column(0.0), y), without.pixel(column(0.0), y));
  }
}

TEST(RenderImage, SurfaceThatMovedIsDrawnWhereItIsNow) {
  LAPWING_NEEDS_GPU();
  Subject sphere(icosphere(3));
  sphere.options.background = Background::transparent;
  const Image rest = sphere.render();
  sphere.move_by(0.15);
  const Image moved = sphere.render();
  const double pixels_per_unit = kPartShown * Subject::kSize / 2.0;
  EXPECT_NEAR(mean_column(moved) - mean_column(rest), 0.15 * pixels_per_unit, 0.1);
  sphere.move_by(0.0);
  EXPECT_EQ(sphere.render().rgba, rest.rgba);
}

TEST(RenderImage, SameInputGivesTheSameBits) {
  LAPWING_NEEDS_GPU();
  Subject one(torus(24, 12, 1.0, 0.4));
  Subject other(torus(24, 12, 1.0, 0.4));
  for (Subject* subject : {&one, &other}) subject->options.style.wireframe = true;
  const Image first = one.render();
  EXPECT_EQ(one.render().rgba, first.rgba);
  EXPECT_EQ(other.render().rgba, first.rgba);
}

TEST(RenderImage, DoesNotDependOnPlaceOrUnit) {
  LAPWING_NEEDS_GPU();
  const Mesh mesh = torus(32, 16, 1.0, 0.4);
  const Image expected = Subject(mesh).render();
  Mesh far = mesh;
  for (Eigen::Vector3d& p : far.positions) p += Eigen::Vector3d(1e6, -2e6, 3e6);
  EXPECT_LT(mean_difference(Subject(far).render(), expected), 0.1);
  for (const double scale : {1e-6, 1e6}) {
    Mesh scaled = mesh;
    for (Eigen::Vector3d& p : scaled.positions) p *= scale;
    EXPECT_LT(mean_difference(Subject(scaled).render(), expected), 0.1);
  }
}

TEST(RenderImage, SurfaceWithoutTrianglesIsAnEmptyPicture) {
  LAPWING_NEEDS_GPU();
  Mesh points;
  points.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Subject subject(points);
  subject.options.background = Background::transparent;
  EXPECT_EQ(coverage(subject.render()), 0.0);
}

TEST(ImageRenderer, DrawsOneAfterTheOtherAsEachAlone) {
  LAPWING_NEEDS_GPU();
  Subject subject(torus(24, 12, 2.0, 0.5));
  ImageRenderer renderer(*subject.context, subject.options);
  for (const View view : {View::front, View::top, View::front}) {
    subject.camera = fit(subject.mesh.positions, view_axes(view), 1.0);
    EXPECT_EQ(renderer.render(subject.surface, subject.paint, subject.camera).rgba,
              subject.render().rgba);
  }
}

}  // namespace
}  // namespace lapwing
