#include "lapwing/io/jpeg_reader.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/jpeg_file.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

Image decoded_jpeg(const std::string& bytes) {
  const TemporaryFolder folder;
  return read_image(folder.file("a.jpg", bytes));
}

std::string jpeg_refusal(const std::string& bytes) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.jpg", bytes);
  return error_message<InputError>([&] { read_image(path); });
}

// Opaque and smooth, so that little of it is lost.
Image shades(std::uint32_t width, std::uint32_t height) {
  Image image{width, height, {}};
  for (std::uint32_t p = 0; p < width * height; ++p) {
    const std::uint32_t x = p % width;
    const std::uint32_t y = p / width;
    image.rgba.insert(image.rgba.end(), {static_cast<std::uint8_t>(40 + 3 * x),
                                         static_cast<std::uint8_t>(200 - 4 * y),
                                         static_cast<std::uint8_t>(90 + x + y), 255});
  }
  return image;
}

void expect_about(const Image& image, const Image& wanted) {
  EXPECT_EQ(image.width, wanted.width);
  EXPECT_EQ(image.height, wanted.height);
  ASSERT_EQ(image.rgba.size(), wanted.rgba.size());
  for (std::size_t at = 0; at < image.rgba.size(); ++at) {
    ASSERT_NEAR(image.rgba[at], wanted.rgba[at], at % 4 == 3 ? 0 : 6) << at;
  }
}

// Where a segment of that marker begins.
std::size_t segment(const std::string& jpeg, char marker) {
  const std::size_t at = jpeg.find(std::string{'\xFF', marker});
  EXPECT_NE(at, std::string::npos);
  return at;
}

std::string with_size(std::string jpeg, const std::string& height_and_width) {
  jpeg.replace(segment(jpeg, '\xC0') + 5, 4, height_and_width);
  return jpeg;
}

TEST(JpegReader, FilesAreToldByTheirFirstTwoBytes) {
  EXPECT_TRUE(is_jpeg("\xFF\xD8\xFF"));
  EXPECT_FALSE(is_jpeg("\xFF"));
  EXPECT_FALSE(is_jpeg("\x89PNG"));
}

TEST(JpegReader, ColorComesBackWhateverTheSamplingAndOrderOfCoefficients) {
  const Image image = shades(37, 21);
  for (const int sampling : {TJSAMP_444, TJSAMP_422, TJSAMP_420, TJSAMP_440, TJSAMP_411}) {
    for (const bool progressive : {false, true}) {
      const std::string jpeg =
          jpeg_file(image.rgba, 37, {.sampling = sampling, .progressive = progressive});
      EXPECT_EQ(jpeg.find("\xFF\xC2") != std::string::npos, progressive);
      SCOPED_TRACE(sampling);
      expect_about(decoded_jpeg(jpeg), image);
    }
  }
}

TEST(JpegReader, GreyIsTheSameInEveryChannel) {
  const std::vector<std::uint8_t> greys{10, 60, 110, 160, 210, 250};
  Image image{3, 2, {}};
  for (const std::uint8_t grey : greys) {
    image.rgba.insert(image.rgba.end(), {grey, grey, grey, 255});
  }
  for (const bool progressive : {false, true}) {
    expect_about(
        decoded_jpeg(jpeg_file(
            greys, 3, {.pixels = TJPF_GRAY, .sampling = TJSAMP_GRAY, .progressive = progressive})),
        image);
  }
}

TEST(JpegReader, InvertedInksAreLightTimesBlack) {
  // No ink; all cyan; half of every light by black; no light.
  const std::vector<std::uint8_t> inks{255, 255, 255, 255, 0,   255, 255, 255,
                                       200, 100, 50,  128, 200, 100, 50,  0};
  std::vector<std::uint8_t> blocks;
  const Image wanted{4, 1, {255, 255, 255, 255, 0, 255, 255, 255, 100, 50, 25, 255, 0, 0, 0, 255}};
  for (std::size_t p = 0; p < 4; ++p) {
    for (int repeat = 0; repeat < 8; ++repeat) {
      blocks.insert(blocks.end(), inks.begin() + 4 * static_cast<std::ptrdiff_t>(p),
                    inks.begin() + 4 * static_cast<std::ptrdiff_t>(p + 1));
    }
  }
  const Image image = decoded_jpeg(jpeg_file(blocks, 32, {.pixels = TJPF_CMYK}));
  ASSERT_EQ(image.width, 32U);
  for (std::uint32_t p = 0; p < 4; ++p) {
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_NEAR(image.pixel(8 * p + 4, 0)[c], wanted.pixel(p, 0)[c], 3) << p << ' ' << c;
    }
  }
}

TEST(JpegReader, InksThatAreNoLuminanceAndChromaAreReadToo) {
  // A file said to hold CMYK: what was the luminance of 255 - ink, 0, is cyan then, and the chroma,
  // 128, magenta and yellow.
  const std::vector<std::uint8_t> white(4 * 64, 255);
  std::string jpeg = jpeg_file(white, 8, {.pixels = TJPF_CMYK});
  const std::size_t adobe = jpeg.find("Adobe");
  ASSERT_NE(adobe, std::string::npos);
  jpeg.at(adobe + 11) = 0;
  EXPECT_THAT(decoded_jpeg(jpeg).pixel(3, 3), ::testing::ElementsAre(0, 128, 128, 255));
}

TEST(JpegReader, FilesCutShortAreRefused) {
  const Image image = shades(24, 16);
  for (const bool progressive : {false, true}) {
    const std::string jpeg = jpeg_file(image.rgba, 24, {.progressive = progressive});
    for (std::size_t length = 2; length < jpeg.size(); ++length) {
      EXPECT_THAT(jpeg_refusal(jpeg.substr(0, length)),
                  AllOf(HasSubstr("a.jpg: cannot read the file as PNG, JPEG, BMP or TGA ("),
                        EndsWith("); convert it to PNG")))
          << length;
    }
  }
}

TEST(JpegReader, ReasonsAreTheLibrarysWithoutItsFunctions) {
  const std::string jpeg = jpeg_file(shades(8, 8).rgba, 8);
  EXPECT_THAT(jpeg_refusal(jpeg.substr(0, jpeg.size() - 2)), HasSubstr("(Premature end of JPEG"));
  EXPECT_THAT(jpeg_refusal(with_size(jpeg, std::string("\0\0\0\x8", 4))), HasSubstr("(Empty JPEG"));
  // Luminance sampled three times as finely.
  std::string uncommon = jpeg;
  uncommon.at(segment(jpeg, '\xC0') + 11) = 0x31;
  EXPECT_THAT(jpeg_refusal(uncommon), HasSubstr("(Could not determine subsampling type"));
}

TEST(JpegReader, MorePixelsThanTheLimitAreRefusedByTheHead) {
  const TemporaryFolder folder;
  const std::string jpeg =
      with_size(jpeg_file(shades(8, 8).rgba, 8), std::string("\x40\0\x40\0", 4));
  const auto path = folder.file("a.jpg", jpeg);
  EXPECT_THAT(error_message<InputError>([&] { read_image(path); }),
              HasSubstr("a.jpg: 16384 x 16384 pixels exceed the limit"));
  EXPECT_THROW(read_image_size(path), InputError);
}

TEST(JpegReader, SizeIsReadOfAHeadAlone) {
  const TemporaryFolder folder;
  const std::string jpeg = jpeg_file(shades(37, 21).rgba, 37);
  const ImageSize size =
      read_image_size(folder.file("a.jpg", jpeg.substr(0, segment(jpeg, '\xDA') + 14)));
  EXPECT_EQ(size.width, 37U);
  EXPECT_EQ(size.height, 21U);
}

// One grey block, whose only coefficient many scans give again.
std::string jpeg_of_scans(int count) {
  const std::vector<std::uint8_t> grey(64, 128);
  std::string jpeg = jpeg_file(grey, 8, {.pixels = TJPF_GRAY, .sampling = TJSAMP_GRAY});
  jpeg.at(segment(jpeg, '\xC0') + 1) = '\xC2';
  const std::size_t first = segment(jpeg, '\xDA');
  std::string scan = jpeg.substr(first, jpeg.size() - 2 - first);
  scan.at(8) = 0;  // the last coefficient
  jpeg.resize(first);
  for (int s = 0; s < count; ++s) jpeg += scan;
  return jpeg + "\xFF\xD9";
}

TEST(JpegReader, ManyScansAreReadAndVeryManyRefused) {
  EXPECT_THAT(decoded_jpeg(jpeg_of_scans(100)).pixel(3, 3),
              ::testing::ElementsAre(128, 128, 128, 255));
  EXPECT_THAT(jpeg_refusal(jpeg_of_scans(1000)), HasSubstr("more than 500 scans"));
}

}  // namespace
}  // namespace lapwing
