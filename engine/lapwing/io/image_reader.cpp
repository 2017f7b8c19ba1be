#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include <turbojpeg.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/io/image.h"

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

[[noreturn]] void throw_image_error(const std::filesystem::path& path, std::string_view reason) {
  throw InputError(path.string() + ": cannot read the file as PNG, JPEG, BMP or TGA (" +
                   std::string(reason) + "); convert it to PNG");
}

[[noreturn]] void fail_to_decode(const std::filesystem::path& path) {
  const char* const reason = stbi_failure_reason();
  throw_image_error(path, reason != nullptr ? reason : "no pixels");
}

// libjpeg-turbo decodes baseline and progressive JPEG files in grey, colour, CMYK and YCCK. The
// decoder assumes that CMYK inks are stored inverted (255 is no ink), as Adobe's programs do. Red
// is then proportional to the product of the stored cyan and black. Colour profiles are ignored.

struct JpegDecoderEnd {
  void operator()(void* decoder) const { tjDestroy(decoder); }
};
using JpegDecoder = std::unique_ptr<void, JpegDecoderEnd>;

JpegDecoder make_jpeg_decoder() {
  JpegDecoder decoder(tjInitDecompress());
  if (!decoder) throw std::bad_alloc();
  return decoder;
}

struct JpegHead {
  int width = 0;
  int height = 0;
  int sampling = 0;
  int colors = 0;

  bool is_of_inks() const { return colors == TJCS_CMYK || colors == TJCS_YCCK; }
};

const unsigned char* data_of(std::string_view bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

[[noreturn]] void refuse_jpeg(const std::filesystem::path& path, const JpegDecoder& decoder) {
  std::string_view reason = tjGetErrorStr2(decoder.get());
  // Some messages begin with the name of the function.
  constexpr std::string_view kAfterFunction = "(): ";
  const std::size_t at = reason.find(kAfterFunction);
  if (at != std::string_view::npos) reason.remove_prefix(at + kAfterFunction.size());
  throw_image_error(path, reason);
}

JpegHead read_head(const std::filesystem::path& path, std::string_view bytes,
                   const JpegDecoder& decoder) {
  JpegHead head;
  if (tjDecompressHeader3(decoder.get(), data_of(bytes), bytes.size(), &head.width, &head.height,
                          &head.sampling, &head.colors) != 0) {
    refuse_jpeg(path, decoder);
  }
  return head;
}

// Replaces inverted inks by the light that they leave: each colour times black.
void put_light_for_inks(Image& image) {
  for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
    const unsigned black = image.rgba[at + 3];
    for (std::size_t c = at; c < at + 3; ++c) {
      image.rgba[c] = static_cast<std::uint8_t>((image.rgba[c] * black + 127) / 255);
    }
    image.rgba[at + 3] = 255;
  }
}

bool is_jpeg(std::string_view bytes) {
  return bytes.starts_with("\xFF\xD8");
}

ImageSize jpeg_size(const std::filesystem::path& path, std::string_view bytes) {
  const JpegHead head = read_head(path, bytes, make_jpeg_decoder());
  return {static_cast<std::uint32_t>(head.width), static_cast<std::uint32_t>(head.height)};
}

// Throws for any error, even if the library could continue, for example in a truncated file. Also
// throws for more than 500 scans, because a scan of a few bytes can take as long as a pass over all
// pixels.
Image decode_jpeg(const std::filesystem::path& path, std::string_view bytes) {
  const JpegDecoder decoder = make_jpeg_decoder();
  const JpegHead head = read_head(path, bytes, decoder);
  Image image{static_cast<std::uint32_t>(head.width), static_cast<std::uint32_t>(head.height), {}};
  image.rgba.resize(std::size_t{4} * image.width * image.height);
  if (tjDecompress2(decoder.get(), data_of(bytes), bytes.size(), image.rgba.data(), head.width,
                    4 * head.width, head.height, head.is_of_inks() ? TJPF_CMYK : TJPF_RGBA,
                    TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS) != 0) {
    refuse_jpeg(path, decoder);
  }
  if (head.is_of_inks()) put_light_for_inks(image);
  return image;
}

// An image file in memory. Error messages call it `path`.
class ImageFile {
 public:
  ImageFile(std::filesystem::path path, std::string_view bytes)
      : path_(std::move(path)), bytes_(bytes) {
    if (bytes_.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      throw InputError(path_.string() + ": the file is larger than 2 GiB; make the image smaller");
    }
  }

  ImageSize size() const {
    const ImageSize size = is_jpeg(bytes_) ? jpeg_size(path_, bytes_) : size_by_stb();
    if (std::uint64_t{size.width} * size.height > kMostImagePixels) {
      throw InputError(path_.string() + ": " + std::to_string(size.width) + " x " +
                       std::to_string(size.height) +
                       " pixels exceed the limit of 8192 x 8192; make the image smaller");
    }
    return size;
  }

  Image decode() const {
    const ImageSize expected = size();
    return is_jpeg(bytes_) ? decode_jpeg(path_, bytes_) : decode_by_stb(expected);
  }

 private:
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

  const stbi_uc* data() const { return reinterpret_cast<const stbi_uc*>(bytes_.data()); }
  int length() const { return static_cast<int>(bytes_.size()); }

  std::filesystem::path path_;
  std::string_view bytes_;
};

}  // namespace

Image read_image(const std::filesystem::path& path) {
  return decode_image(FileBytes::read_data(path).view(), path.string());
}

ImageSize read_image_size(const std::filesystem::path& path) {
  return decode_image_size(FileBytes::read_data(path).view(), path.string());
}

Image decode_image(std::string_view bytes, const std::string& name) {
  return ImageFile(name, bytes).decode();
}

ImageSize decode_image_size(std::string_view bytes, const std::string& name) {
  return ImageFile(name, bytes).size();
}

}  // namespace lapwing
