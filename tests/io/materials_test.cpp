#include "lapwing/io/materials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Optional;
using ::testing::SizeIs;

class Mtl : public ::testing::Test {
 protected:
  std::vector<Material> read(std::string_view text) {
    notes_.clear();
    return read_material_library(folder_.file("a.mtl", text), notes_);
  }
  Material read_one(const std::string& lines) {
    const std::vector<Material> materials = read("newmtl m\n" + lines);
    EXPECT_THAT(materials, SizeIs(1));
    return materials.at(0);
  }

  TemporaryFolder folder_;
  std::vector<std::string> notes_;
};

TEST_F(Mtl, MaterialsHaveColorsAndImages) {
  const auto materials = read(
      "\xEF\xBB\xBF# made by hand\r\nnewmtl red paint \r\n\tKd 1 0.25 0\r\nKa 1 1 1\r\n"
      "newmtl skin\r\nKD 0.5\r\nmap_Kd .\\skin of a cat.png\r\nnewmtl nothing");
  ASSERT_THAT(materials, SizeIs(3));
  EXPECT_EQ(materials[0].name, "red paint");
  EXPECT_THAT(materials[0].color, Optional(Vector3f(1, 0.25F, 0)));
  EXPECT_THAT(materials[0].image, IsEmpty());
  EXPECT_THAT(materials[1].color, Optional(Vector3f(0.5F, 0.5F, 0.5F)));
  EXPECT_EQ(materials[1].image, ".\\skin of a cat.png");
  EXPECT_EQ(materials[2].color, std::nullopt);
  EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(Mtl, OptionsOfAnImageAreNoPartOfItsName) {
  const Material material = read_one(
      "map_Kd -blendu off -s 2 4 1 -o 0.5 -0.25 -mm 0 1 -clamp on -texres 512 7 of 9.png\n");
  EXPECT_EQ(material.image, "7 of 9.png");
  EXPECT_EQ(material.uv_scale, Vector2d(2, 4));
  EXPECT_EQ(material.uv_offset, Vector2d(0.5, -0.25));
  EXPECT_EQ(read_one("map_kd -s 3 a.png").uv_scale, Vector2d(3, 1));
  EXPECT_EQ(read_one("map_Kd \"a b.png\"\n").image, "a b.png");
  EXPECT_EQ(read_one("map_Kd -odd name.png\n").image, "-odd name.png");
}

TEST_F(Mtl, OptionsMayFollowTheNameOfAnImage) {
  const Material material = read_one("map_Kd a - b.png -s 2 4 1\t-clamp on -o 0.5 -0.25 \n");
  EXPECT_EQ(material.image, "a - b.png");
  EXPECT_EQ(material.uv_scale, Vector2d(2, 4));
  EXPECT_EQ(material.uv_offset, Vector2d(0.5, -0.25));
  EXPECT_TRUE(material.is_clamped);
  EXPECT_EQ(read_one("map_Kd \"a b.png\" -bm 1 -type sphere\n").image, "a b.png");
  EXPECT_EQ(read_one("map_Kd -s 2 a.png -o 1\n").uv_scale, Vector2d(2, 1));
  for (const std::string name :
       {"skin -s 2.png", "skin -clamp on top.png", "-bm", "a-s 2", "-o.png"}) {
    EXPECT_EQ(read_one("map_Kd " + name + "\n").image, name == "-bm" ? "" : name);
  }
}

TEST_F(Mtl, AnImageIsClampedIfItsOptionIsOn) {
  EXPECT_TRUE(read_one("map_Kd -clamp on -s 1 1 1 file name.png\n").is_clamped);
  EXPECT_FALSE(read_one("map_Kd -clamp off file name.png\n").is_clamped);
  EXPECT_FALSE(read_one("map_Kd file name.png\n").is_clamped);
  EXPECT_EQ(read_one("map_Kd -clamp file.png\n").image, "file.png");
}

TEST_F(Mtl, ColorsStayInRange) {
  EXPECT_THAT(read_one("Kd 2 -1 0.5\n").color, Optional(Vector3f(1, 0, 0.5F)));
}

TEST_F(Mtl, WhatCannotBeReadIsANoteWithItsLine) {
  EXPECT_EQ(read_one("Kd spectral file.rfl\nKd 1 nan 1\nmap_Kd -s 1 1\n").color, std::nullopt);
  ASSERT_THAT(notes_, SizeIs(3));
  EXPECT_THAT(notes_[0], HasSubstr("a.mtl:2: expected Kd with one or three numbers; "));
  EXPECT_THAT(notes_[1], HasSubstr("a.mtl:3: "));
  EXPECT_THAT(notes_[2], HasSubstr("a.mtl:4: map_Kd has no file name; "));
}

TEST_F(Mtl, OfTwoMaterialsWithOneNameTheFirstIsUsed) {
  const auto materials = read("newmtl a\nKd 1 1 1\nnewmtl a\nKd 0 0 0\nnewmtl b\n");
  ASSERT_THAT(materials, SizeIs(2));
  EXPECT_THAT(materials[0].color, Optional(Vector3f(1, 1, 1)));
  EXPECT_THAT(notes_,
              ElementsAre(EndsWith(
                  "a.mtl:3: material 'a' is defined a second time; the first definition is used")));
}

TEST_F(Mtl, AnythingElseIsPassedOver) {
  EXPECT_THAT(read("Kd 1 1 1\nmap_Kd a.png\n\n\n#newmtl a\nnewmtlx\n"), IsEmpty());
  EXPECT_THAT(read(std::string("\0\xFF\xFE\x01 \n\n\r", 7)), IsEmpty());
  EXPECT_THAT(notes_, IsEmpty());
  EXPECT_THROW(read_material_library(folder_ / "none.mtl", notes_), IoError);
}

}  // namespace
}  // namespace lapwing
