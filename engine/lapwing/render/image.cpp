#include "lapwing/render/image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/atomic_file.h"

namespace lapwing {
namespace {

constexpr std::uint8_t kOpaque = 255;
// The encoder counts in int, with room for its own overhead.
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 29U;

// IEC 61966-2-1.
float linear_of(std::uint8_t encoded) {
  const float c = static_cast<float>(encoded) / 255.0F;
  return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

std::uint8_t encoded_of(float linear) {
  const float c = std::clamp(linear, 0.0F, 1.0F);
  const float s = c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255.0F * s));
}

std::vector<std::uint8_t> without_opacity(const Image& image) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(image.rgba.size() / 4 * 3);
  for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
    const auto pixel = image.rgba.begin() + static_cast<std::ptrdiff_t>(at);
    rgb.insert(rgb.end(), pixel, pixel + 3);
  }
  return rgb;
}

}  // namespace

void divide_by_opacity(Image& image) {
  for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
    const std::uint8_t opacity = image.rgba[at + 3];
    if (opacity == 0 || opacity == kOpaque) continue;
    for (std::size_t channel = at; channel < at + 3; ++channel) {
      image.rgba[channel] = encoded_of(linear_of(image.rgba[channel]) * 255.0F / opacity);
    }
  }
}

void put_on_black(Image& image) {
  for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
    const std::uint8_t opacity = std::exchange(image.rgba[at + 3], kOpaque);
    if (opacity == kOpaque) continue;
    for (std::size_t channel = at; channel < at + 3; ++channel) {
      image.rgba[channel] = encoded_of(linear_of(image.rgba[channel]) * opacity / 255.0F);
    }
  }
}

std::string encode_png(const Image& image) {
  if (std::uint64_t{4} * image.width * image.height > kMaxBytes) {
    throw IoError("an image of " + std::to_string(image.width) + " x " +
                  std::to_string(image.height) +
                  " pixels is too large for a PNG file; choose a smaller size");
  }
  bool opaque = true;
  for (std::size_t at = 3; at < image.rgba.size(); at += 4) opaque &= image.rgba[at] == kOpaque;
  const std::vector<std::uint8_t> pixels = opaque ? without_opacity(image) : image.rgba;
  const int channels = opaque ? 3 : 4;
  const auto width = static_cast<int>(image.width);
  const auto append = [](void* bytes, void* data, int size) {
    static_cast<std::string*>(bytes)->append(static_cast<const char*>(data),
                                             static_cast<std::size_t>(size));
  };
  std::string bytes;
  if (stbi_write_png_to_func(append, &bytes, width, static_cast<int>(image.height), channels,
                             pixels.data(), width * channels) == 0) {
    throw IoError("an image of " + std::to_string(image.width) + " x " +
                  std::to_string(image.height) +
                  " pixels cannot be encoded as PNG: no memory, or no pixels");
  }
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  replace_file(path, encode_png(image));
}

}  // namespace lapwing
