#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing {

/// An image in memory: rows from top to bottom, four bytes per pixel: red, green, blue (sRGB) and
/// opacity. The colours are not premultiplied by the opacity.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 width height bytes

  /// Returns the pixel at column `x` and row `y`, which must be inside.
  std::array<std::uint8_t, 4> pixel(std::uint32_t x, std::uint32_t y) const {
    const std::uint8_t* p = rgba.data() + 4 * (std::size_t{y} * width + x);
    return {p[0], p[1], p[2], p[3]};
  }
};

/// Divides premultiplied colours by their opacity, in linear light.
void unpremultiply(Image& image);

/// Composites the image over black, in linear light. The result is opaque.
void composite_over_black(Image& image);

/// In pixels.
struct ImageSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// Half as many columns and rows, rounded down, but at least 1 of each.
ImageSize halved(const ImageSize& size);
/// Returns an image of that size. Every pixel is the mean of the pixels that it covers, in linear
/// light. Opacity is averaged separately.
Image halved(const Image& image);

/// Reads a PNG, JPEG, BMP or TGA file; the content decides which. Opacity is 255 if the file has
/// none. Throws IoError if the file cannot be read, and InputError if it has another format, is
/// corrupt or has more than `kMostImagePixels`. That limit also bounds the memory.
Image read_image(const std::filesystem::path& path);

/// 8192 x 8192.
inline constexpr std::uint64_t kMostImagePixels = std::uint64_t{1} << 26U;

/// Returns the size of the image that `read_image` would read, from the head of the file. Throws
/// what `read_image` throws, but does not see errors further on.
ImageSize read_image_size(const std::filesystem::path& path);

/// These functions read an image file from memory instead. Error messages call it `name`.
Image decode_image(std::string_view bytes, const std::string& name);
ImageSize decode_image_size(std::string_view bytes, const std::string& name);

/// Returns the bytes of a PNG file, without the fourth channel if the whole image is opaque. Stores
/// `software`, if not empty, as the program that made the file. Throws IoError for more than 2^29
/// bytes of pixels.
std::string encode_png(const Image& image, std::string_view software = {});

/// Whether `bytes` begin like a PNG file that `encode_png` made with that `software`.
bool is_png_made_by(std::string_view bytes, std::string_view software);

/// Writes a PNG file, replacing `path` in one step. Throws IoError with the system's reason.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace lapwing
