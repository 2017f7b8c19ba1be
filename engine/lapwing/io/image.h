#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing {

/// A picture in memory: rows from the top, four bytes per pixel (red, green, blue in sRGB, and
/// opacity, which the colours are not multiplied by).
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 width height bytes

  /// Of column `x` and row `y`, both inside.
  std::array<std::uint8_t, 4> pixel(std::uint32_t x, std::uint32_t y) const {
    const std::uint8_t* p = rgba.data() + 4 * (std::size_t{y} * width + x);
    return {p[0], p[1], p[2], p[3]};
  }
};

/// Turns colours that were multiplied by their opacity (in linear light) into plain ones.
void divide_by_opacity(Image& image);

/// Puts the image before black: colours multiplied by their opacity (in linear light), and opaque.
void put_on_black(Image& image);

/// In pixels.
struct ImageSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// Half as many columns and rows, rounded down, but at least 1 of each.
ImageSize halved(const ImageSize& size);
/// An image of that size: every pixel is the mean, in linear light, of what it covers. Opacity is
/// averaged apart from the colours.
Image halved(const Image& image);

/// Reads a PNG, JPEG, BMP or TGA file; the content says which. Opacity is 255 where it has none.
/// Throws IoError when the file cannot be read, InputError when it is none of these, is broken or
/// has more than `kMostImagePixels`. Memory is bounded by that limit, whatever the file says.
Image read_image(const std::filesystem::path& path);

/// 8192 x 8192.
inline constexpr std::uint64_t kMostImagePixels = std::uint64_t{1} << 26U;

/// The columns and rows of the image that `read_image` would read, from the head of the file.
/// Throws what that throws, but for a file that is broken further on.
ImageSize read_image_size(const std::filesystem::path& path);

/// The bytes of a PNG file; without the fourth channel where all of the image is opaque.
/// `software`, if any, stands in it as what made it. Throws IoError for more than 2^29 bytes of
/// pixels.
std::string encode_png(const Image& image, std::string_view software = {});

/// Whether the bytes of a PNG file begin as `encode_png` begins them with that `software`.
bool is_png_made_by(std::string_view bytes, std::string_view software);

/// Writes a PNG file, replacing `path` in one step. Throws IoError with the system's reason.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace lapwing
