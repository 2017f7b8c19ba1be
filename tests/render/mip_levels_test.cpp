#include "lapwing/render/mip_levels.h"

#include <bit>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lapwing {
namespace {

using ::testing::ElementsAre;

constexpr std::size_t kTable = 256;

Image numbered(std::uint32_t width, std::uint32_t height) {
  Image image{width, height, {}};
  for (std::uint32_t p = 0; p < width * height; ++p) {
    image.rgba.insert(image.rgba.end(), {static_cast<std::uint8_t>(p), 7, 9, 128});
  }
  return image;
}

TEST(MipLevels, BeginWithTheLightOfEachByte) {
  const auto words = mip_levels({});
  ASSERT_EQ(words.size(), kTable);
  EXPECT_EQ(std::bit_cast<float>(words[0]), 0.0F);
  EXPECT_EQ(std::bit_cast<float>(words[255]), 1.0F);
  EXPECT_NEAR(std::bit_cast<float>(words[188]), 0.5F, 0.005F);
}

TEST(MipLevels, GoDownToOnePixelOfEachImage) {
  const std::vector<Image> images{numbered(5, 2), {}, numbered(1, 1)};
  const auto words = mip_levels(images);
  const auto record = [&](std::size_t image) {
    const auto* first = words.data() + kTable + 4 * image;
    return std::vector<std::uint32_t>(first, first + 4);
  };
  const std::uint32_t places = kTable + 12;
  EXPECT_THAT(record(0), ElementsAre(5, 2, 3, places));
  EXPECT_THAT(record(1), ElementsAre(0, 0, 0, places + 3));
  EXPECT_THAT(record(2), ElementsAre(1, 1, 1, places + 3));
  const std::uint32_t pixels = places + 4;
  EXPECT_EQ(words[places], pixels);
  EXPECT_EQ(words[places + 1], pixels + 10);
  EXPECT_EQ(words[places + 2], pixels + 12);
  EXPECT_EQ(words[places + 3], pixels + 13);
  EXPECT_EQ(words.size(), pixels + 14);
  for (std::uint32_t p = 0; p < 10; ++p) EXPECT_EQ(words[pixels + p], 0x090700U + p);
}

}  // namespace
}  // namespace lapwing
