#include "lapwing/io/image.h"

#include <cmath>
#include <filesystem>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Image decoded(const std::string& bytes) {
  const TemporaryFolder folder;
  return read_image(folder.file("image", bytes));
}

// The type of a PNG file's pixels: 2 without opacity, 6 with it.
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
  const std::string jpeg = written_by([&](auto append, void* to) {
    stbi_write_jpg_to_func(append, to, 3, 2, 4, image.rgba.data(), 100);
  });
  EXPECT_EQ(decoded(bmp).rgba, image.rgba);
  EXPECT_EQ(decoded(tga).rgba, image.rgba);
  const Image lossy = decoded(jpeg);
  ASSERT_EQ(lossy.rgba.size(), image.rgba.size());
  for (std::size_t at = 0; at < image.rgba.size(); ++at) {
    EXPECT_NEAR(lossy.rgba[at], image.rgba[at], 6);
  }
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
  // Black and white in turn: half the light is 188 in sRGB, and not 128.
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
  // One white pixel of five: a fifth of the light, wherever it stands.
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

}  // namespace
}  // namespace lapwing
