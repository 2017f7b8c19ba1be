#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/gpu/buffer.h"
#include "lapwing/render/color_map.h"
#include "lapwing/render/surface_paint.h"

namespace lapwing {

/// An axis-aligned rectangle over an image, in the layout of the overlay shader.
struct OverlayRectangle {
  std::array<float, 4> corners;  ///< left, top, right, bottom in pixels from the top left
  std::array<float, 4> color;    ///< linear sRGB and opacity
};

/// Rectangles that form legends and text over an image. `OverlayBuffer` uploads them.
class Overlay {
 public:
  void add_rectangle(float left, float top, float right, float bottom,
                     const Eigen::Vector3f& linear_color);
  /// Adds one line of text with its top left corner at (x, y). Characters other than printable
  /// ASCII are shown as '?'. Capital letters are 7 * `scale` pixels high.
  void add_text(float x, float y, float scale, const Eigen::Vector3f& linear_color,
                std::string_view text);
  /// Returns the width in pixels of the text that `add_text` draws.
  static float text_width(float scale, std::string_view text);

  const std::vector<OverlayRectangle>& rectangles() const { return rectangles_; }

 private:
  std::vector<OverlayRectangle> rectangles_;
};

struct Legend {
  ColorMap color_map = ColorMap::sequential;
  ScalarRange range;
  std::string title;        ///< one or more lines, or empty
  bool more_above = false;  ///< values above the range have the last colour
  bool less_below = false;  ///< values below the range have the first colour
};

/// Returns a colour bar for the right edge of an image of `width` x `height` pixels. Its ends and
/// middle are labelled with values (">= 3" if `more_above`), and the title is above it. Sizes are
/// proportional to the image height.
Overlay legend_overlay(const Legend& legend, std::uint32_t width, std::uint32_t height);

/// Returns the fraction of the width of an image of this size that a legend covers, at most 1/2.
/// The lines of its title must have at most kLegendLetters letters.
double legend_share(std::uint32_t width, std::uint32_t height);
inline constexpr int kLegendLetters = 13;

/// An overlay in device memory. The device must have finished its draws before it is destroyed. The
/// context must outlive it.
class OverlayBuffer {
 public:
  OverlayBuffer(gpu::Context& context, const Overlay& overlay);

  std::uint32_t rectangle_count() const { return count_; }
  const gpu::Buffer& buffer() const { return buffer_; }  ///< OverlayRectangles

 private:
  std::uint32_t count_;
  gpu::Buffer buffer_;
};

}  // namespace lapwing
