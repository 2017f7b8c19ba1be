#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include <turbojpeg.h>

namespace lapwing {

struct JpegOptions {
  int pixels = TJPF_RGBA;  ///< pixel format, one of TJPF_*
  int sampling = TJSAMP_444;
  int quality = 100;
  bool progressive = false;
};

/// Returns a JPEG file that is `width` pixels wide. The first row of `pixels` is the top row.
inline std::string jpeg_file(std::span<const std::uint8_t> pixels, int width,
                             const JpegOptions& options = {}) {
  const std::unique_ptr<void, decltype(&tjDestroy)> encoder(tjInitCompress(), &tjDestroy);
  const int row = width * tjPixelSize[options.pixels];
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const int status =
      tjCompress2(encoder.get(), pixels.data(), width, row, static_cast<int>(pixels.size()) / row,
                  options.pixels, &bytes, &size, options.sampling, options.quality,
                  options.progressive ? TJFLAG_PROGRESSIVE : 0);
  const std::unique_ptr<unsigned char, decltype(&tjFree)> owned(bytes, &tjFree);
  if (status != 0) throw std::runtime_error(tjGetErrorStr2(encoder.get()));
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace lapwing
