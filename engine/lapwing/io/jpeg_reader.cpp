#include "lapwing/io/jpeg_reader.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

#include <turbojpeg.h>

#include "lapwing/io/image_refusal.h"

namespace lapwing {
namespace {

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

}  // namespace

bool is_jpeg(std::string_view bytes) {
  return bytes.starts_with("\xFF\xD8");
}

ImageSize JpegReader::size() const {
  const JpegHead head = read_head(path_, bytes_, make_jpeg_decoder());
  return {static_cast<std::uint32_t>(head.width), static_cast<std::uint32_t>(head.height)};
}

Image JpegReader::decode() const {
  const JpegDecoder decoder = make_jpeg_decoder();
  const JpegHead head = read_head(path_, bytes_, decoder);
  Image image{static_cast<std::uint32_t>(head.width), static_cast<std::uint32_t>(head.height), {}};
  image.rgba.resize(std::size_t{4} * image.width * image.height);
  if (tjDecompress2(decoder.get(), data_of(bytes_), bytes_.size(), image.rgba.data(), head.width,
                    4 * head.width, head.height, head.is_of_inks() ? TJPF_CMYK : TJPF_RGBA,
                    TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS) != 0) {
    refuse_jpeg(path_, decoder);
  }
  if (head.is_of_inks()) put_light_for_inks(image);
  return image;
}

}  // namespace lapwing
