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

/// An axis-aligned rectangle over a picture, as the overlay shader reads it.
struct OverlayRectangle {
  std::array<float, 4> corners;  ///< left, top, right, bottom in pixels from the top left
  std::array<float, 4> color;    ///< linear sRGB and opacity
};

/// Flat rectangles drawn over a picture: legends and text. Plain data; `OverlayBuffer` uploads it.
class Overlay {
 public:
  void add_rectangle(float left, float top, float right, float bottom,
                     const Eigen::Vector3f& linear_color);
  /// Adds one line of printable ASCII (other characters show as '?') with its top left corner at
  /// (x, y). Capital letters are 7 `scale` pixels high.
  void add_text(float x, float y, float scale, const Eigen::Vector3f& linear_color,
                std::string_view text);
  /// Returns the width in pixels of what `add_text` draws.
  static float text_width(float scale, std::string_view text);

  const std::vector<OverlayRectangle>& rectangles() const { return rectangles_; }

 private:
  std::vector<OverlayRectangle> rectangles_;
};

/// Contents of a legend.
struct Legend {
  ColorMap color_map = ColorMap::sequential;
  ScalarRange range;
  std::string title;        ///< one or more lines, or empty
  bool more_above = false;  ///< numbers above the range have its last colour
  bool less_below = false;  ///< numbers below the range have its first colour
};

/// Returns a bar of the colour map at the right edge of a picture of `width` x `height` pixels. It
/// has numbers at its ends and middle (">= 3" if `more_above`) and the title above. Sizes follow
/// the picture's height.
Overlay legend_overlay(const Legend& legend, std::uint32_t width, std::uint32_t height);

/// Returns the fraction of such a picture's width, at the right, that a legend covers if its title
/// has up to kLegendLetters per line: at most half.
double legend_share(std::uint32_t width, std::uint32_t height);
inline constexpr int kLegendLetters = 13;

/// An overlay in device memory. The device must have finished with it before it is destroyed. The
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
