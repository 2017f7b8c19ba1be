#include "domain_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace lapwing::cli {
namespace {

using Eigen::Vector2d;

constexpr double kMargin = 0.04;  // as a fraction of the image size
constexpr double kBoldWidth = 3.0;
constexpr double kThickestLine = 1.2;
constexpr double kThinnestLine = 0.25;
constexpr double kLinePerEdge = 0.12;  // line width as a fraction of the mean edge length
constexpr double kPinRadius = 6.0;
constexpr double kSpotRadius = 3.0;
using Color = std::array<std::uint8_t, 3>;  // red, green, blue in sRGB
constexpr Color kBlue{30, 60, 120};
constexpr Color kRed{220, 30, 30};

// The coverage of each pixel by a layer of ink. Overlapping lines do not add up, so that their
// intersections are not darker.
class Ink {
 public:
  explicit Ink(std::uint32_t size) : size_(size), coverage_(std::size_t{size} * size, 0.0F) {}

  void line(const Vector2d& a, const Vector2d& b, double width) {
    // A line thinner than a pixel is drawn one pixel wide, with less coverage.
    const double drawn = std::max(width, 1.0);
    const double strength = width / drawn;
    const double reach = 0.5 * drawn + 0.5;
    const Vector2d edge = b - a;
    const double squared = edge.squaredNorm();
    for_rows(std::min(a.y(), b.y()) - reach, std::max(a.y(), b.y()) + reach, [&](int y) {
      const auto [left, right] = columns(a, b, y + 0.5, reach);
      for (int x = left; x <= right; ++x) {
        const Vector2d p(x + 0.5, y + 0.5);
        const double share =
            squared > 0.0 ? std::clamp((p - a).dot(edge) / squared, 0.0, 1.0) : 0.0;
        cover(x, y, strength * (reach - (a + share * edge - p).norm()));
      }
    });
  }

  void dot(const Vector2d& center, double radius) { line(center, center, 2.0 * radius); }

  void triangle(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    const auto side = [](const Vector2d& p, const Vector2d& q, const Vector2d& r) {
      return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
    };
    const double way = side(a, b, c) < 0.0 ? -1.0 : 1.0;
    const int left = pixel(std::min({a.x(), b.x(), c.x()}));
    const int right = pixel(std::max({a.x(), b.x(), c.x()}));
    const auto [low, high] = std::minmax({a.y(), b.y(), c.y()});
    for_rows(low, high, [&](int y) {
      for (int x = left; x <= right; ++x) {
        const Vector2d p(x + 0.5, y + 0.5);
        if (way * side(a, b, p) >= 0.0 && way * side(b, c, p) >= 0.0 &&
            way * side(c, a, p) >= 0.0) {
          cover(x, y, 1.0);
        }
      }
    });
  }

  // Draws the ink on the image and clears it.
  void print(const Color& color, Image& image) {
    for (std::size_t k = 0; k < coverage_.size(); ++k) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        std::uint8_t& value = image.rgba[4 * k + channel];
        const double mixed = value + (color[channel] - value) * double{coverage_[k]};
        value = static_cast<std::uint8_t>(std::lround(mixed));
      }
    }
    std::fill(coverage_.begin(), coverage_.end(), 0.0F);
  }

 private:
  int pixel(double at) const {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, size_ - 1.0));
  }

  template <class Row>
  void for_rows(double low, double high, const Row& row) const {
    for (int y = pixel(low); y <= pixel(high); ++y) row(y);
  }

  // Returns the range of pixels in one row that are within `reach` of the segment.
  std::array<int, 2> columns(const Vector2d& a, const Vector2d& b, double y, double reach) const {
    double low = std::min(a.x(), b.x());
    double high = std::max(a.x(), b.x());
    const double rise = b.y() - a.y();
    if (std::abs(rise) > 2.0 * reach) {
      // Clip the segment to the band of rows around y that the width of the line spans.
      const double at_first = a.x() + (b.x() - a.x()) * ((y - 2.0 * reach - a.y()) / rise);
      const double at_last = a.x() + (b.x() - a.x()) * ((y + 2.0 * reach - a.y()) / rise);
      low = std::max(low, std::min(at_first, at_last));
      high = std::min(high, std::max(at_first, at_last));
    }
    return {pixel(low - reach), pixel(high + reach)};
  }

  void cover(int x, int y, double share) {
    float& pixel = coverage_[static_cast<std::size_t>(y) * size_ + static_cast<std::size_t>(x)];
    pixel = std::max(pixel, static_cast<float>(std::clamp(share, 0.0, 1.0)));
  }

  std::uint32_t size_;
  std::vector<float> coverage_;
};

// Maps points of the domain to pixels, with v upward.
std::vector<Vector2d> to_pixels(Domain domain, std::span<const Vector2d> points, double size) {
  const double margin = kMargin * size;
  const double extent = size - 2.0 * margin;
  std::vector<Vector2d> pixels;
  pixels.reserve(points.size());
  for (const Vector2d& p : points) {
    const Vector2d share = domain == Domain::disk ? Vector2d(0.5 * (p + Vector2d(1, 1))) : p;
    pixels.emplace_back(margin + extent * share.x(), size - margin - extent * share.y());
  }
  return pixels;
}

double mean_edge(std::span<const Triangle> triangles, std::span<const Vector2d> pixels) {
  double sum = 0.0;
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) sum += (pixels[t[k]] - pixels[t[(k + 1) % 3]]).norm();
  }
  return sum / std::max(1.0, 3.0 * static_cast<double>(triangles.size()));
}

}  // namespace

Image draw_domain(const Parameterized& result, std::uint32_t size) {
  Image image{size, size, std::vector<std::uint8_t>(4 * std::size_t{size} * size, 255)};
  Ink ink(size);
  const auto& triangles = result.patch.triangles;
  const auto& loop = result.patch.loop;
  const std::vector<Vector2d> pixels = to_pixels(result.map.domain, result.map.points, size);
  const double width =
      std::clamp(kLinePerEdge * mean_edge(triangles, pixels), kThinnestLine, kThickestLine);
  for (const Triangle& t : triangles) {
    // Draw each inner edge once; boundary edges follow below.
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] < t[(k + 1) % 3]) ink.line(pixels[t[k]], pixels[t[(k + 1) % 3]], width);
    }
  }
  for (std::size_t k = 0; k < loop.size(); ++k) {
    ink.line(pixels[loop[k]], pixels[loop[(k + 1) % loop.size()]], kBoldWidth);
  }
  for (const Index pin : result.pins) ink.dot(pixels[pin], kPinRadius);
  ink.print(kBlue, image);
  for (const Index t : result.flipped) {
    const auto& [a, b, c] = triangles[t];
    ink.triangle(pixels[a], pixels[b], pixels[c]);
    ink.dot((pixels[a] + pixels[b] + pixels[c]) / 3.0, kSpotRadius);
  }
  ink.print(kRed, image);
  return image;
}

}  // namespace lapwing::cli
