#include "lapwing/io/image.h"

#include <cmath>
#include <filesystem>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include "io/jpeg_file.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

Image decoded(const std::string& bytes) {
  const TemporaryFolder folder;
  return read_image(folder.file("image", bytes));
}

// Returns the colour type of a PNG file: 2 without an opacity channel, 6 with one.
int color_type(const std::string& png) {
  return png.at(25);
}

template <class Write>
std::string written_by(const Write& write) {
  std::string bytes;
  write(
      [](void* into, void* data, int size) {
        static_cast<std::string*>(into)->append(static_cast<const char*>(data),
                                                static_cast<std::size_t>(size));
      },
      &bytes);
  return bytes;
}

Image gradient(std::uint8_t opacity) {
  Image image{3, 2, {}};
  for (std::uint8_t p = 0; p < 6; ++p) {
    image.rgba.insert(image.rgba.end(), {static_cast<std::uint8_t>(40 * p), 100, p, opacity});
  }
  return image;
}

TEST(Png, DecodesToTheImage) {
  const Image image = gradient(128);
  const Image back = decoded(encode_png(image));
  EXPECT_EQ(back.width, 3U);
  EXPECT_EQ(back.height, 2U);
  EXPECT_EQ(back.rgba, image.rgba);
}

TEST(Png, OpaqueImagesAreStoredWithoutOpacity) {
  const Image image = gradient(255);
  const std::string png = encode_png(image);
  EXPECT_EQ(color_type(png), 2);
  EXPECT_EQ(color_type(encode_png(gradient(128))), 6);
  EXPECT_EQ(decoded(png).rgba, image.rgba);
}

TEST(Png, ImagesTooLargeForTheEncoderAreRefused) {
  EXPECT_THROW(encode_png(Image{40000, 40000, {}}), IoError);
}

TEST(Png, FolderThatDoesNotExistIsAnError) {
  const auto path = std::filesystem::temp_directory_path() / "lapwing no such folder" / "a.png";
  EXPECT_THROW(write_png(path, gradient(255)), IoError);
}

TEST(Image, OnBlackIsOpaqueAndAsDarkAsItWasTransparent) {
  Image image{3, 1, {200, 100, 50, 255, 200, 100, 50, 128, 200, 100, 50, 0}};
  composite_over_black(image);
  EXPECT_THAT(image.pixel(0, 0), ElementsAre(200, 100, 50, 255));
  EXPECT_THAT(image.pixel(1, 0), ElementsAre(147, 72, 34, 255)) << "half the light";
  EXPECT_THAT(image.pixel(2, 0), ElementsAre(0, 0, 0, 255));
}

TEST(Image, DividingByOpacityGivesBackTheColor) {
  // 188 encodes half the light of 255.
  Image image{3, 1, {188, 188, 0, 128, 90, 80, 70, 255, 0, 0, 0, 0}};
  unpremultiply(image);
  EXPECT_NEAR(image.pixel(0, 0)[0], 255, 1);
  EXPECT_EQ(image.pixel(0, 0)[2], 0);
  EXPECT_THAT(image.pixel(1, 0), ElementsAre(90, 80, 70, 255));
  EXPECT_THAT(image.pixel(2, 0), ElementsAre(0, 0, 0, 0));
}

TEST(ReadImage, EveryFormatIsToldByItsContent) {
  const Image image = gradient(255);
  const std::string bmp = written_by([&](auto append, void* to) {
    stbi_write_bmp_to_func(append, to, 3, 2, 4, image.rgba.data());
  });
  const std::string tga = written_by([&](auto append, void* to) {
    stbi_write_tga_to_func(append, to, 3, 2, 4, image.rgba.data());
  });
  EXPECT_EQ(decoded(bmp).rgba, image.rgba);
  EXPECT_EQ(decoded(tga).rgba, image.rgba);
}

TEST(ReadImage, WhatIsBrokenIsRefusedByName) {
  const TemporaryFolder folder;
  const std::string png = encode_png(gradient(255));
  const auto refusal = [&](const std::string& bytes) {
    const auto path = folder.file("a.png", bytes);
    return error_message<InputError>([&] { read_image(path); });
  };
  EXPECT_THAT(refusal(""), HasSubstr("a.png: cannot read the file as PNG, JPEG, BMP or TGA"));
  EXPECT_THAT(refusal("no image at all"), HasSubstr("convert it to PNG"));
  for (std::size_t length = 1; length + 12 < png.size(); ++length) {
    EXPECT_THAT(refusal(png.substr(0, length)), HasSubstr("a.png")) << length;
  }
  EXPECT_THROW(read_image(folder / "none.png"), IoError);
}

TEST(ReadImage, MorePixelsThanTheLimitAreRefusedBeforeTheyAreRead) {
  const TemporaryFolder folder;
  std::string png = encode_png(gradient(255));
  // Columns and rows in the head, 16,384 each.
  png.replace(16, 8, std::string("\0\0\x40\0\0\0\x40\0", 8));
  const auto path = folder.file("a.png", png);
  EXPECT_THAT(error_message<InputError>([&] { read_image(path); }),
              HasSubstr("16384 x 16384 pixels exceed the limit"));
  EXPECT_THROW(read_image_size(path), InputError);
}

TEST(HalvedImage, MeansAreOfLight) {
  // The mean of black and white in linear light is 0.5, which is 188 in sRGB, not 128.
  Image board{8, 6, {}};
  for (std::uint32_t p = 0; p < 48; ++p) {
    const std::uint8_t value = (p / 8 + p) % 2 == 0 ? 0 : 255;
    board.rgba.insert(board.rgba.end(), {value, value, value, 255});
  }
  const Image half = halved(board);
  EXPECT_EQ(half.width, 4U);
  EXPECT_EQ(half.height, 3U);
  for (std::uint32_t y = 0; y < 3; ++y) {
    for (std::uint32_t x = 0; x < 4; ++x) {
      EXPECT_THAT(half.pixel(x, y), ElementsAre(188, 188, 188, 255));
    }
  }
}

TEST(HalvedImage, EveryPixelOfAnOddSizeCountsAlike) {
  // One of five pixels is white. Its position must not change the mean, a fifth of the light.
  for (std::uint32_t white = 0; white < 5; ++white) {
    Image line{5, 1, std::vector<std::uint8_t>(20, 0)};
    for (std::size_t c = 0; c < 3; ++c) line.rgba[4 * white + c] = 255;
    const Image half = halved(line);
    ASSERT_EQ(half.width, 2U);
    ASSERT_EQ(half.height, 1U);
    const auto light = [&](std::uint32_t x) {
      return std::pow((half.pixel(x, 0)[0] / 255.0 + 0.055) / 1.055, 2.4);
    };
    EXPECT_NEAR(0.5 * (light(0) + light(1)), 0.2, 0.005) << white;
  }
}

TEST(HalvedImage, OneColorStaysToTheLastLevel) {
  Image image{13, 7, {}};
  for (int p = 0; p < 13 * 7; ++p) image.rgba.insert(image.rgba.end(), {90, 90, 90, 90});
  while (image.width > 1 || image.height > 1) {
    image = halved(image);
    EXPECT_THAT(image.rgba, Each(90));
  }
}

std::string jpeg_refusal(const std::string& bytes) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.jpg", bytes);
  return error_message<InputError>([&] { read_image(path); });
}

// Returns an opaque, smooth image, which lossy compression changes only slightly.
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

// Returns the offset of the first segment with this marker.
std::size_t segment(const std::string& jpeg, char marker) {
  const std::size_t at = jpeg.find(std::string{'\xFF', marker});
  EXPECT_NE(at, std::string::npos);
  return at;
}

std::string with_size(std::string jpeg, const std::string& height_and_width) {
  jpeg.replace(segment(jpeg, '\xC0') + 5, 4, height_and_width);
  return jpeg;
}

TEST(JpegReader, ColorComesBackWhateverTheSamplingAndOrderOfCoefficients) {
  const Image image = shades(37, 21);
  for (const int sampling : {TJSAMP_444, TJSAMP_422, TJSAMP_420, TJSAMP_440, TJSAMP_411}) {
    for (const bool progressive : {false, true}) {
      const std::string jpeg =
          jpeg_file(image.rgba, 37, {.sampling = sampling, .progressive = progressive});
      EXPECT_EQ(jpeg.find("\xFF\xC2") != std::string::npos, progressive);
      SCOPED_TRACE(sampling);
      expect_about(decoded(jpeg), image);
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
        decoded(jpeg_file(
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
  const Image image = decoded(jpeg_file(blocks, 32, {.pixels = TJPF_CMYK}));
  ASSERT_EQ(image.width, 32U);
  for (std::uint32_t p = 0; p < 4; ++p) {
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_NEAR(image.pixel(8 * p + 4, 0)[c], wanted.pixel(p, 0)[c], 3) << p << ' ' << c;
    }
  }
}

TEST(JpegReader, InksThatAreNoLuminanceAndChromaAreReadToo) {
  // The changed byte declares CMYK instead of YCCK. The decoder then reads the luminance of
  // 255 - ink, which is 0, as cyan, and the chroma values, which are 128, as magenta and yellow.
  const std::vector<std::uint8_t> white(4 * 64, 255);
  std::string jpeg = jpeg_file(white, 8, {.pixels = TJPF_CMYK});
  const std::size_t adobe = jpeg.find("Adobe");
  ASSERT_NE(adobe, std::string::npos);
  jpeg.at(adobe + 11) = 0;
  EXPECT_THAT(decoded(jpeg).pixel(3, 3), ::testing::ElementsAre(0, 128, 128, 255));
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

// Returns a file with one grey block. Each of the `count` scans repeats its only coefficient.
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
  EXPECT_THAT(decoded(jpeg_of_scans(100)).pixel(3, 3), ::testing::ElementsAre(128, 128, 128, 255));
  EXPECT_THAT(jpeg_refusal(jpeg_of_scans(1000)), HasSubstr("more than 500 scans"));
}

}  // namespace
}  // namespace lapwing
