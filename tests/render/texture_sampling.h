#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/image.h"

// The CPU twin of shaders/file_color.glsl.
namespace lapwing::test {

/// Converts a byte in sRGB to linear light.
inline double light_of(double byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

inline Eigen::Array3d light_of(const std::array<std::uint8_t, 4>& pixel) {
  return {light_of(pixel[0]), light_of(pixel[1]), light_of(pixel[2])};
}

/// An image in linear light. The first row is at the top. The image repeats in both directions.
struct LightImage {
  int width = 0;
  int height = 0;
  std::vector<Eigen::Array3d> pixels;

  const Eigen::Array3d& at(int x, int y) const {
    const auto wrap = [](int i, int n) { return (i % n + n) % n; };
    return pixels[static_cast<std::size_t>(wrap(y, height) * width + wrap(x, width))];
  }
};

inline LightImage light_image(const Image& image) {
  LightImage light{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x)
      light.pixels.push_back(light_of(image.pixel(x, y)));
  }
  return light;
}

/// Returns the next mip level of an image whose sides are powers of two.
inline LightImage next_level(const LightImage& fine) {
  LightImage half{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
  const int columns = fine.width / half.width;
  const int rows = fine.height / half.height;
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) sum += fine.at(columns * x + i, rows * y + j);
      }
      half.pixels.emplace_back(sum / (rows * columns));
    }
  }
  return half;
}

/// Returns the colour at `place`. (0, 0) is the upper left corner and (1, 1) the lower right one.
inline Eigen::Array3d bilinear(const LightImage& image, const Eigen::Vector2d& place) {
  const double x = place.x() * image.width - 0.5;
  const double y = place.y() * image.height - 0.5;
  const int left = static_cast<int>(std::floor(x));
  const int top = static_cast<int>(std::floor(y));
  const double right_share = x - left;
  const double lower_share = y - top;
  return (1 - lower_share) *
             ((1 - right_share) * image.at(left, top) + right_share * image.at(left + 1, top)) +
         lower_share * ((1 - right_share) * image.at(left, top + 1) +
                        right_share * image.at(left + 1, top + 1));
}

/// Returns the colour at `place` for a rendered pixel that is `texels` texels wide.
inline Eigen::Array3d trilinear(LightImage image, const Eigen::Vector2d& place, double texels) {
  double level = std::max(0.0, std::log2(texels));
  while (level >= 1.0 && image.pixels.size() > 1) {
    image = next_level(image);
    level -= 1.0;
  }
  if (image.pixels.size() == 1) level = 0.0;
  const Eigen::Array3d fine = bilinear(image, place);
  return level == 0.0 ? fine : (1 - level) * fine + level * bilinear(next_level(image), place);
}

}  // namespace lapwing::test
