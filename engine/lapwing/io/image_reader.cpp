#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "lapwing/base/errors.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/io/image.h"
#include "lapwing/io/image_refusal.h"
#include "lapwing/io/jpeg_reader.h"

namespace lapwing {
namespace {

// Refuses allocations above 16 bytes per pixel of the largest image; no decoder needs more. A small
// file can claim to unpack into gigabytes.
void* allocate_for_image(void* old, std::size_t bytes) {
  return bytes <= 16 * kMostImagePixels ? std::realloc(old, bytes) : nullptr;
}

}  // namespace
}  // namespace lapwing

#define STBI_MALLOC(bytes) ::lapwing::allocate_for_image(nullptr, bytes)
#define STBI_REALLOC(old, bytes) ::lapwing::allocate_for_image(old, bytes)
#define STBI_FREE(old) std::free(old)
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
// Other formats of stb are rarely textures, and most of its known faults are in their decoders.
// libjpeg-turbo reads JPEG files.
#define STBI_ONLY_PNG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#include <stb/stb_image.h>

namespace lapwing {
namespace {

constexpr int kImageChannels = 4;

[[noreturn]] void fail_to_decode(const std::filesystem::path& path) {
  const char* const reason = stbi_failure_reason();
  throw_image_error(path, reason != nullptr ? reason : "no pixels");
}

// An image's file in memory.
class ImageFile {
 public:
  explicit ImageFile(const std::filesystem::path& path)
      : path_(path), bytes_(FileBytes::read(path)) {
    if (bytes_.view().size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      throw InputError(path.string() + ": the file is larger than 2 GiB; make the image smaller");
    }
  }

  ImageSize size() const {
    const ImageSize size = is_jpeg(bytes_.view()) ? jpeg().size() : size_by_stb();
    if (std::uint64_t{size.width} * size.height > kMostImagePixels) {
      throw InputError(path_.string() + ": " + std::to_string(size.width) + " x " +
                       std::to_string(size.height) +
                       " pixels exceed the limit of 8192 x 8192; make the image smaller");
    }
    return size;
  }

  Image decode() const {
    const ImageSize expected = size();
    return is_jpeg(bytes_.view()) ? jpeg().decode() : decode_by_stb(expected);
  }

 private:
  JpegReader jpeg() const { return {path_, bytes_.view()}; }

  ImageSize size_by_stb() const {
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(data(), length(), &width, &height, &channels) == 0 || width <= 0 ||
        height <= 0) {
      fail_to_decode(path_);
    }
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
  }

  Image decode_by_stb(const ImageSize& expected) const {
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(data(), length(), &width, &height, &channels, kImageChannels),
        &stbi_image_free);
    if (!pixels) fail_to_decode(path_);
    Image image{expected.width, expected.height, {}};
    image.rgba.assign(pixels.get(),
                      pixels.get() + std::size_t{kImageChannels} * image.width * image.height);
    return image;
  }

  const stbi_uc* data() const { return reinterpret_cast<const stbi_uc*>(bytes_.view().data()); }
  int length() const { return static_cast<int>(bytes_.view().size()); }

  std::filesystem::path path_;
  FileBytes bytes_;
};

}  // namespace

Image read_image(const std::filesystem::path& path) {
  return ImageFile(path).decode();
}

ImageSize read_image_size(const std::filesystem::path& path) {
  return ImageFile(path).size();
}

}  // namespace lapwing
