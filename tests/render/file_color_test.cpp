// Compares surfaces that are drawn in the colours of their file with the CPU twin.
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/render/mip_levels.h"
#include "render/picture.h"
#include "render/texture_sampling.h"
#include "render/textured_square.h"
#include "support/gpu.h"
#include "support/keep_picture.h"

namespace lapwing {
namespace {

using Eigen::Array3d;
using Eigen::Vector2d;
using test::light_image;
using test::light_of;
using test::LightImage;
using test::Subject;
using test::textured_square;
using test::trilinear;

constexpr double kPixelsPerUnit = (1.0 - 2.0 * Subject::kMargin) * Subject::kSize;
// The tolerance in linear light. Each of the three rendered images can be wrong by the largest
// difference between two successive sRGB bytes.
constexpr double kStep = 0.015;

Image noise(std::uint32_t width, std::uint32_t height) {
  std::mt19937 random(7);
  Image image{width, height, {}};
  for (std::uint32_t p = 0; p < width * height; ++p) {
    for (int c = 0; c < 3; ++c) image.rgba.push_back(static_cast<std::uint8_t>(random() % 256));
    image.rgba.push_back(static_cast<std::uint8_t>(p % 2 == 0 ? 0 : 255));  // opacity is ignored
  }
  return image;
}

Image of_one_color(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  return {1, 1, {r, g, b, 255}};
}

// Draws a mesh in the colours of a file and recovers these colours in linear light. Renderings with
// a white and a black texture show how the renderer lights each pixel.
class InFileColors {
 public:
  explicit InFileColors(const Mesh& mesh) : subject(mesh) {
    subject.options.style.file_colors = true;
    white_ = with_image(of_one_color(255, 255, 255));
    black_ = with_image(of_one_color(0, 0, 0));
  }

  Image with_image(const Image& image) {
    FileColors colors;
    colors.images.push_back(image);
    colors.materials.push_back({.name = "skin", .image = 0});
    return with(colors);
  }
  Image with(const FileColors& colors) {
    subject.paint.set_file_colors(subject.mesh, subject.mesh, FilePaint(colors));
    return subject.render();
  }

  Array3d color(const Image& picture, std::uint32_t x, std::uint32_t y) const {
    const Array3d black = light_of(black_.pixel(x, y));
    return (light_of(picture.pixel(x, y)) - black) / (light_of(white_.pixel(x, y)) - black);
  }

  Subject subject;

 private:
  Image white_;
  Image black_;
};

// Returns the point of the unit square that is drawn at the centre of a pixel.
Vector2d place_under(std::uint32_t x, std::uint32_t y) {
  const Vector2d pixel(x + 0.5, y + 0.5);
  const Vector2d across = (pixel.array() - 0.5 * Subject::kSize) / kPixelsPerUnit;
  return {0.5 + across.x(), 0.5 - across.y()};
}

// Returns the largest difference over the pixels that lie inside the square and whose neighbours
// also do.
template <class Difference>
double largest_inside(const Difference& difference_at) {
  const auto first = static_cast<std::uint32_t>(Subject::kMargin * Subject::kSize) + 2;
  double largest = 0.0;
  for (std::uint32_t y = first; y < Subject::kSize - first; ++y) {
    for (std::uint32_t x = first; x < Subject::kSize - first; ++x) {
      largest = std::max(largest, static_cast<double>(difference_at(x, y)));
    }
  }
  return largest;
}

struct Mapping {
  std::string name;
  std::uint32_t width;
  std::uint32_t height;
  double repeats;  // number of images along a side
  double degrees;  // rotation of the image
};

void PrintTo(const Mapping& mapping, std::ostream* out) {
  *out << mapping.name;
}

class FilteredImage : public ::testing::TestWithParam<Mapping> {};

TEST_P(FilteredImage, AgreesWithTheProcessors) {
  LAPWING_NEEDS_GPU();
  const Mapping& m = GetParam();
  const Eigen::Matrix2d uv_of_place =
      m.repeats * Eigen::Rotation2Dd(m.degrees / 180.0 * std::numbers::pi).toRotationMatrix();
  InFileColors picture(textured_square(
      [&](const Vector2d& p) -> Vector2d { return uv_of_place * p - Vector2d(0.3, 5.7); }));
  const Image image = noise(m.width, m.height);
  const LightImage light = light_image(image);
  const Image shown = picture.with_image(image);
  test::keep_picture(shown, "file-color-" + m.name);
  // The larger of the texture distances, in texels, to the next pixel on the right and below.
  const Eigen::Matrix2d steps =
      Vector2d(m.width, m.height).asDiagonal() * uv_of_place / kPixelsPerUnit;
  const double texels = std::max(steps.col(0).norm(), steps.col(1).norm());
  const double largest = largest_inside([&](std::uint32_t x, std::uint32_t y) {
    const Vector2d uv = uv_of_place * place_under(x, y) - Vector2d(0.3, 5.7);
    const Array3d expected = trilinear(light, {uv.x(), 1.0 - uv.y()}, texels);
    return (picture.color(shown, x, y) - expected).abs().maxCoeff();
  });
  EXPECT_LT(largest, kStep);
}

INSTANTIATE_TEST_SUITE_P(
    Mappings, FilteredImage,
    ::testing::Values(Mapping{"magnified", 4, 4, 1.0, 0.0}, Mapping{"repeated", 8, 8, 2.6, 0.0},
                      Mapping{"turned", 16, 4, 1.5, 33.0}, Mapping{"reduced", 64, 64, 3.5, 0.0},
                      Mapping{"reducedandturned", 128, 32, 5.0, 70.0},
                      Mapping{"line", 32, 1, 1.0, 0.0}, Mapping{"onepixel", 1, 1, 9.0, 10.0}),
    [](const auto& mapping) { return mapping.param.name; });

TEST(FileColor, CheckerboardFromAfarIsItsMeanInLightWithoutMoire) {
  LAPWING_NEEDS_GPU();
  Image board{64, 64, {}};
  for (std::uint32_t p = 0; p < 64 * 64; ++p) {
    const std::uint8_t value = (p / 64 + p) % 2 == 0 ? 0 : 255;
    board.rgba.insert(board.rgba.end(), {value, value, value, 255});
  }
  // One rendered pixel covers between 2 and 40 texels.
  for (const double repeats : {3.3, 10.1, 64.7}) {
    InFileColors picture(
        textured_square([&](const Vector2d& p) -> Vector2d { return repeats * p; }));
    const Image shown = picture.with_image(board);
    const double largest = largest_inside([&](std::uint32_t x, std::uint32_t y) {
      return (picture.color(shown, x, y) - 0.5).abs().maxCoeff();
    });
    EXPECT_LT(largest, kStep) << repeats;
  }
}

TEST(FileColor, SeamIsSharp) {
  LAPWING_NEEDS_GPU();
  // The corners left of the diagonal lie in the left half of the image, the others in the right
  // half.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add_face(std::array<Index, 3>{0, 2, 3});
  mesh.add_face(std::array<Index, 3>{0, 1, 2});
  MeshAttributes& a = mesh.edit_attributes();
  a.uvs = {{0.25, 0.5}, {0.75, 0.5}};
  a.corner_uvs = {0, 0, 0, 1, 1, 1};
  a.materials = {"skin"};
  a.face_materials = {0, 0};
  InFileColors picture(mesh);
  const Image shown = picture.with_image({2, 1, {255, 0, 0, 255, 0, 0, 255, 255}});
  const double largest = largest_inside([&](std::uint32_t x, std::uint32_t y) {
    const Vector2d p = place_under(x, y);
    if (std::abs(p.x() - p.y()) * kPixelsPerUnit < 2.0) return 0.0;
    const Array3d expected = p.x() < p.y() ? Array3d(1, 0, 0) : Array3d(0, 0, 1);
    return (picture.color(shown, x, y) - expected).abs().maxCoeff();
  });
  EXPECT_LT(largest, kStep);
}

TEST(FileColor, ColorsOfVerticesBlendInLight) {
  LAPWING_NEEDS_GPU();
  Mesh mesh = textured_square();
  InFileColors picture(mesh);
  for (const Eigen::Vector3d& p : mesh.positions) {
    const auto x = static_cast<float>(p.x());
    mesh.edit_attributes().vertex_colors.emplace_back(x, 1.0F - x, 1.0F, 1.0F);
  }
  picture.subject.mesh = mesh;
  const Image shown = picture.with({});
  const double largest = largest_inside([&](std::uint32_t x, std::uint32_t y) {
    const double across = place_under(x, y).x();
    const Array3d expected(across, 1.0 - across, 1.0);
    return (picture.color(shown, x, y) - expected).abs().maxCoeff();
  });
  EXPECT_LT(largest, kStep);
}

TEST(FileColor, WithoutAnyThePictureIsPlain) {
  LAPWING_NEEDS_GPU();
  Subject plain(textured_square());
  const Image expected = plain.render();
  plain.options.style.file_colors = true;
  EXPECT_EQ(plain.render().rgba, expected.rgba);
  InFileColors picture(textured_square());
  EXPECT_TRUE(picture.subject.paint.has_file_colors());
  EXPECT_NE(picture.with_image(noise(4, 4)).rgba, expected.rgba);
  picture.subject.options.style.file_colors = false;
  EXPECT_EQ(picture.subject.render().rgba, expected.rgba);
  EXPECT_EQ(picture.with({}).rgba, expected.rgba);
  EXPECT_FALSE(picture.subject.paint.has_file_colors());
}

TEST(FileColor, StaysOnTheSurfaceWhereThatMoves) {
  LAPWING_NEEDS_GPU();
  InFileColors picture(textured_square());
  const Image before = picture.with_image(noise(8, 8));
  constexpr std::uint32_t kMoved = 8;
  picture.subject.move_by(kMoved / kPixelsPerUnit);
  const Image after = picture.subject.render();
  const double largest = largest_inside([&](std::uint32_t x, std::uint32_t y) {
    return (light_of(after.pixel(x + kMoved, y)) - light_of(before.pixel(x, y))).abs().maxCoeff();
  });
  EXPECT_LT(largest, kStep);
}

TEST(FileColor, RegionsTintItButForWhatIsOutside) {
  LAPWING_NEEDS_GPU();
  InFileColors picture(textured_square());
  const Image image = noise(8, 8);
  const Image bare = picture.with_image(image);
  picture.subject.options.style.color = SurfaceColor::regions;
  EXPECT_EQ(picture.subject.render().rgba, bare.rgba);
  picture.subject.paint.set_classes(std::vector<VertexClass>(4, VertexClass::handle));
  const Image tinted = picture.subject.render();
  picture.subject.options.style.file_colors = false;
  const Image yellow = picture.subject.render();
  double beyond = 0.0;
  const double shows_through = largest_inside([&](std::uint32_t x, std::uint32_t y) {
    // The colour has the luminance of the image and the hue of the class.
    const Array3d image_light =
        Array3d::Constant((light_of(bare.pixel(x, y)) * Array3d(0.2126, 0.7152, 0.0722)).sum());
    const Array3d class_light = light_of(yellow.pixel(x, y));
    const Array3d light = light_of(tinted.pixel(x, y));
    const Array3d outside =
        (image_light.min(class_light) - light).max(light - image_light.max(class_light));
    beyond = std::max(beyond, outside.maxCoeff());
    return (light - class_light).abs().maxCoeff();
  });
  EXPECT_LT(beyond, 0.03) << "the lights have a hue";
  EXPECT_GT(shows_through, 0.2);
}

TEST(FileColor, CountsOfAnotherMeshAreRefused) {
  LAPWING_NEEDS_GPU();
  Subject one(textured_square());
  Mesh other = textured_square();
  other.add_face(std::array<Index, 3>{0, 1, 2});
  EXPECT_THROW(one.paint.set_file_colors(other, other, FilePaint({})), InputError);
}

}  // namespace
}  // namespace lapwing
