#include "lapwing/render/mip_levels.h"

#include <bit>

#include "lapwing/base/srgb.h"

namespace lapwing {
namespace {

constexpr std::size_t kLinearWords = 256;  // shaders/file_color.glsl
constexpr std::size_t kImageWords = 4;

std::uint32_t level_count(const Image& image) {
  if (image.rgba.empty()) return 0;
  return static_cast<std::uint32_t>(std::bit_width(std::max(image.width, image.height)));
}

void append_pixels(const Image& image, std::vector<std::uint32_t>& words) {
  for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
    words.push_back(image.rgba[at] | static_cast<std::uint32_t>(image.rgba[at + 1]) << 8U |
                    static_cast<std::uint32_t>(image.rgba[at + 2]) << 16U);
  }
}

}  // namespace

std::vector<std::uint32_t> mip_levels(std::span<const Image> images) {
  std::vector<std::uint32_t> words;
  for (std::size_t b = 0; b < kLinearWords; ++b) {
    words.push_back(std::bit_cast<std::uint32_t>(linear_of_srgb(static_cast<std::uint8_t>(b))));
  }
  std::size_t places = kLinearWords + kImageWords * images.size();
  for (const Image& image : images) {
    const std::uint32_t levels = level_count(image);
    words.insert(words.end(),
                 {image.width, image.height, levels, static_cast<std::uint32_t>(places)});
    places += levels;
  }
  std::size_t place = words.size();
  words.resize(places);
  for (const Image& image : images) {
    Image level = image;
    for (std::uint32_t l = level_count(image); l > 0; --l) {
      words[place++] = static_cast<std::uint32_t>(words.size());
      append_pixels(level, words);
      if (l > 1) level = halved(level);
    }
  }
  return words;
}

}  // namespace lapwing
