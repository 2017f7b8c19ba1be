#pragma once

#include <filesystem>
#include <string_view>

#include "lapwing/io/image.h"

namespace lapwing {

/// Whether a file begins as every JPEG file does.
bool is_jpeg(std::string_view bytes);

/// A JPEG file, decoded by libjpeg-turbo: baseline and progressive, grey, colour, and the four inks
/// of CMYK and YCCK. Inks are taken for inverted, as Adobe's programs write them and nearly every
/// such file has them (255 is no ink): red is the cyan of the file times its black. Colour profiles
/// are not applied. `bytes` must outlive it; `path` is what messages name.
class JpegReader {
 public:
  JpegReader(const std::filesystem::path& path, std::string_view bytes)
      : path_(path), bytes_(bytes) {}

  /// By the head, before memory is taken for any pixel. Throws InputError where that is broken, or
  /// says 12 bits a channel or a sampling of colours that libjpeg-turbo has no name for.
  ImageSize size() const;

  /// An opaque image of size(), which the caller has found small enough. Takes up to 12 bytes a
  /// pixel. Throws InputError where anything is amiss, also where the library could go on with a
  /// guess (a file cut short, bytes between segments), and for more than 500 scans: each may cost
  /// the time of all pixels, in a few bytes.
  Image decode() const;

 private:
  std::filesystem::path path_;
  std::string_view bytes_;
};

}  // namespace lapwing
