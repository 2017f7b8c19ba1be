#include "lapwing/io/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "lapwing/base/errors.h"
#include "lapwing/base/srgb.h"
#include "lapwing/io/atomic_file.h"

namespace lapwing {
namespace {

constexpr std::uint8_t kOpaque = 255;
// The encoder counts bytes in int. This limit leaves room for its overhead.
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 29U;

// The signature and the chunk IHDR, which comes first.
constexpr std::size_t kPngHead = 8 + 25;

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes += static_cast<char>(value >> shift & 0xFFU);
  }
  return bytes;
}

// CRC of ISO 3309, as in the PNG specification. Bit by bit, because texts are short.
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

// PNG specification, 11.3.4.3: the keyword, a zero, the text.
std::string text_chunk(std::string_view software) {
  const std::string data = std::string("Software") + '\0' + std::string(software);
  return big_endian(static_cast<std::uint32_t>(data.size())) + "tEXt" + data +
         big_endian(crc32("tEXt" + data));
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

void unpremultiply(Image& image) {
  for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
    const std::uint8_t opacity = image.rgba[at + 3];
    if (opacity == 0 || opacity == kOpaque) continue;
    for (std::size_t channel = at; channel < at + 3; ++channel) {
      image.rgba[channel] = srgb_byte_of(linear_of_srgb(image.rgba[channel]) * 255.0F / opacity);
    }
  }
}

void composite_over_black(Image& image) {
  for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
    const std::uint8_t opacity = std::exchange(image.rgba[at + 3], kOpaque);
    if (opacity == kOpaque) continue;
    for (std::size_t channel = at; channel < at + 3; ++channel) {
      image.rgba[channel] = srgb_byte_of(linear_of_srgb(image.rgba[channel]) * opacity / 255.0F);
    }
  }
}

namespace {

// The pixels along one axis that one pixel of the halved image covers, and their weights.
struct Covered {
  std::uint32_t first = 0;
  std::array<float, 3> shares{};  // of `first` and the next two; their sum is 1
};

// If `length` is odd, each pixel of the half covers slightly more than two.
Covered covered_by(std::uint32_t to, std::uint32_t half, std::uint32_t length) {
  const double step = static_cast<double>(length) / half;
  const double begin = to * step;
  Covered covered{.first = static_cast<std::uint32_t>(begin)};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const double from = std::max(begin, static_cast<double>(covered.first + k));
    const double until = std::min(begin + step, static_cast<double>(covered.first + k + 1));
    covered.shares[k] = static_cast<float>(std::max(0.0, until - from) / step);
  }
  return covered;
}

}  // namespace

ImageSize halved(const ImageSize& size) {
  return {std::max(1U, size.width / 2), std::max(1U, size.height / 2)};
}

Image halved(const Image& image) {
  const ImageSize size = halved(ImageSize{image.width, image.height});
  Image half{size.width, size.height, {}};
  half.rgba.reserve(std::size_t{4} * half.width * half.height);
  std::array<float, 256> linear;
  for (std::size_t b = 0; b < linear.size(); ++b) {
    linear[b] = linear_of_srgb(static_cast<std::uint8_t>(b));
  }
  std::vector<Covered> columns;
  for (std::uint32_t x = 0; x < half.width; ++x) {
    columns.push_back(covered_by(x, half.width, image.width));
  }
  for (std::uint32_t y = 0; y < half.height; ++y) {
    const Covered rows = covered_by(y, half.height, image.height);
    for (const Covered& column : columns) {
      std::array<float, 4> sum{};
      for (std::uint32_t j = 0; j < 3; ++j) {
        for (std::uint32_t i = 0; i < 3; ++i) {
          const float share = rows.shares[j] * column.shares[i];
          if (share == 0.0F) continue;
          const auto pixel = image.pixel(column.first + i, rows.first + j);
          for (std::size_t c = 0; c < 3; ++c) sum[c] += share * linear[pixel[c]];
          sum[3] += share * static_cast<float>(pixel[3]);
        }
      }
      for (std::size_t c = 0; c < 3; ++c) half.rgba.push_back(srgb_byte_of(sum[c]));
      half.rgba.push_back(static_cast<std::uint8_t>(std::lround(sum[3])));
    }
  }
  return half;
}

bool is_png_made_by(std::string_view bytes, std::string_view software) {
  return bytes.size() > kPngHead && bytes.substr(kPngHead).starts_with(text_chunk(software));
}

std::string encode_png(const Image& image, std::string_view software) {
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
                  " pixels cannot be encoded as PNG: out of memory, or the image is empty");
  }
  if (!software.empty()) bytes.insert(kPngHead, text_chunk(software));
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  replace_file(path, encode_png(image));
}

}  // namespace lapwing
