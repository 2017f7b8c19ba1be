#include "lapwing/render/image.h"

#include <filesystem>
#include <memory>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;

struct Decoded {
  Image image;
  int channels = 0;
};

Decoded decode(const std::string& png) {
  int width = 0;
  int height = 0;
  Decoded decoded;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()),
                            static_cast<int>(png.size()), &width, &height, &decoded.channels, 4),
      &stbi_image_free);
  if (!pixels) return decoded;
  decoded.image.width = static_cast<std::uint32_t>(width);
  decoded.image.height = static_cast<std::uint32_t>(height);
  decoded.image.rgba.assign(pixels.get(), pixels.get() + 4 * width * height);
  return decoded;
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
  const Decoded decoded = decode(encode_png(image));
  EXPECT_EQ(decoded.image.width, 3U);
  EXPECT_EQ(decoded.image.height, 2U);
  EXPECT_EQ(decoded.image.rgba, image.rgba);
}

TEST(Png, OpaqueImagesAreStoredWithoutOpacity) {
  const Image image = gradient(255);
  const Decoded decoded = decode(encode_png(image));
  EXPECT_EQ(decoded.channels, 3);
  EXPECT_EQ(decoded.image.rgba, image.rgba);
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
  put_on_black(image);
  EXPECT_THAT(image.pixel(0, 0), ElementsAre(200, 100, 50, 255));
  EXPECT_THAT(image.pixel(1, 0), ElementsAre(147, 72, 34, 255)) << "half the light";
  EXPECT_THAT(image.pixel(2, 0), ElementsAre(0, 0, 0, 255));
}

TEST(Image, DividingByOpacityGivesBackTheColor) {
  // 188 encodes half the light of 255.
  Image image{3, 1, {188, 188, 0, 128, 90, 80, 70, 255, 0, 0, 0, 0}};
  divide_by_opacity(image);
  EXPECT_NEAR(image.pixel(0, 0)[0], 255, 1);
  EXPECT_EQ(image.pixel(0, 0)[2], 0);
  EXPECT_THAT(image.pixel(1, 0), ElementsAre(90, 80, 70, 255));
  EXPECT_THAT(image.pixel(2, 0), ElementsAre(0, 0, 0, 0));
}

}  // namespace
}  // namespace lapwing
