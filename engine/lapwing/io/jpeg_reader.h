#pragma once

#include <filesystem>
#include <string_view>

#include "lapwing/io/image.h"

namespace lapwing {

/// Whether `bytes` begin with the marker of a JPEG file.
bool is_jpeg(std::string_view bytes);

/// Decodes a JPEG file with libjpeg-turbo: baseline and progressive, grey, colour, CMYK and YCCK.
/// Inks are assumed to be inverted (255 is no ink), as Adobe's programs and nearly all such files
/// store them: red is the cyan of the file times its black. Colour profiles are not applied.
/// `bytes` must outlive the reader; messages name `path`.
class JpegReader {
 public:
  JpegReader(const std::filesystem::path& path, std::string_view bytes)
      : path_(path), bytes_(bytes) {}

  /// Reads the size from the header, before any pixel is allocated. Throws InputError if the header
  /// is corrupt, has 12 bits per channel, or has a chroma subsampling unknown to libjpeg-turbo.
  ImageSize size() const;

  /// Returns an opaque image of size(), which the caller must check first. Takes up to 12 bytes per
  /// pixel. Throws InputError for any error, even if the library could guess (a truncated file,
  /// bytes between segments). Throws it also for more than 500 scans, because each may cost the
  /// time of all pixels in a few bytes.
  Image decode() const;

 private:
  std::filesystem::path path_;
  std::string_view bytes_;
};

}  // namespace lapwing
