#include "lapwing/render/overlay.h"

#include <algorithm>
#include <cstring>

#include <stb/stb_easy_font.h>

#include "lapwing/render/surface.h"

namespace lapwing {
namespace {

// Returns the mutable ASCII string that the font needs. Replaces 0 by O, because the font's slashed
// 0 looks like an 8.
std::string as_ascii(std::string_view text) {
  std::string line(text);
  for (char& c : line) {
    if (c < ' ' || c > '~') c = '?';
    if (c == '0') c = 'O';
  }
  return line;
}

// A corner in the output format of the font. Each rectangle has four.
struct FontCorner {
  float x, y, z;
  std::uint32_t color;
};

// Upper bound of the number of rectangles of a letter.
constexpr std::size_t kRectanglesPerLetter = 24;

}  // namespace

void Overlay::add_rectangle(float left, float top, float right, float bottom,
                            const Eigen::Vector3f& linear_color) {
  rectangles_.push_back(
      {{left, top, right, bottom}, {linear_color.x(), linear_color.y(), linear_color.z(), 1.0F}});
}

void Overlay::add_text(float x, float y, float scale, const Eigen::Vector3f& linear_color,
                       std::string_view text) {
  std::string line = as_ascii(text);
  std::vector<FontCorner> corners(4 * kRectanglesPerLetter * line.size() + 4);
  const int count = stb_easy_font_print(0.0F, 0.0F, line.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(FontCorner)));
  for (int r = 0; r < count; ++r) {
    const FontCorner& first = corners[4 * static_cast<std::size_t>(r)];
    const FontCorner& opposite = corners[4 * static_cast<std::size_t>(r) + 2];
    add_rectangle(x + scale * first.x, y + scale * first.y, x + scale * opposite.x,
                  y + scale * opposite.y, linear_color);
  }
}

float Overlay::text_width(float scale, std::string_view text) {
  return scale * static_cast<float>(stb_easy_font_width(as_ascii(text).data()));
}

OverlayBuffer::OverlayBuffer(gpu::Context& context, const Overlay& overlay)
    : count_(static_cast<std::uint32_t>(overlay.rectangles().size())),
      buffer_(context, "overlay", overlay.rectangles().size() * sizeof(OverlayRectangle),
              gpu::Memory::upload) {
  std::copy(overlay.rectangles().begin(), overlay.rectangles().end(),
            buffer_.mapped_as<OverlayRectangle>().begin());
}

}  // namespace lapwing
