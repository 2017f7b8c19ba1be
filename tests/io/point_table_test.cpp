#include "lapwing/io/point_table.h"

#include <bit>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class APointTable : public ::testing::Test {
 protected:
  PointTable read(const std::string& text, const std::string& name = "p.csv") {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return read_point_table(folder_ / name);
  }
  std::string error(const std::string& text) {
    return error_message<InputError>([&] { read(text); });
  }

  // An array of numpy with the bytes of `numbers`.
  template <class Number>
  static std::string npy(const std::string& type, int rows, int columns,
                         const std::vector<Number>& numbers) {
    const std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" +
                               std::to_string(rows) + ", " + std::to_string(columns) + "), }\n";
    std::string bytes = "\x93NUMPY";
    bytes += {'\x01', '\x00', static_cast<char>(header.size()), '\x00'};
    bytes += header;
    return bytes.append(reinterpret_cast<const char*>(numbers.data()),
                        numbers.size() * sizeof(Number));
  }

  TemporaryFolder folder_;
};

TEST_F(APointTable, HasPositionsAndANormalOrAQuaternionByTheNumberOfItsColumns) {
  const PointTable bare = read("1,2,3\n4,5,6\n");
  EXPECT_EQ(bare.positions, (Positions{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_THAT(bare.normals, IsEmpty());
  EXPECT_THAT(bare.rotations, IsEmpty());
  EXPECT_EQ(read("1 2 3 0 0 1\n").normals.at(0), Vector3d(0, 0, 1));
  const Eigen::Quaterniond q = read("1 2 3 0.6 0 0.8 0\n").rotations.at(0);
  EXPECT_EQ(q.w(), 0.6);
  EXPECT_EQ(q.y(), 0.8);
}

TEST_F(APointTable, HasWhatItsFirstLineNames) {
  const PointTable points = read("\"NZ\",id,Y,X,Z,nx,ny\n1,77,2,3,4,0,0.5\n");
  EXPECT_EQ(points.positions.at(0), Vector3d(3, 2, 4));
  EXPECT_EQ(points.normals.at(0), Vector3d(0, 0.5, 1));
  EXPECT_THAT(error("x,y,w\n1,2,3\n"), HasSubstr("p.csv: its first line names 2 of the 3"));
  EXPECT_THAT(error("x,y,z\n1,2,3,4\n"), HasSubstr("p.csv:2: expected 3 numbers"));
}

TEST_F(APointTable, ChangesNoByteButThoseOfTheNumbersThatMoved) {
  const std::string text = "# by hand\nid; x; y; z\r\n1; 0.50; 1e0; 2\r\n\n2; +3; 4.000; 5 ;\n";
  PointTable points = read(text);
  EXPECT_EQ(bytes_of(points), text);
  points.positions[0].y() = 0.1;
  points.positions[1] = {3, -1.25, 1e300};
  EXPECT_EQ(bytes_of(points),
            "# by hand\nid; x; y; z\r\n1; 0.50; 0.1; 2\r\n\n2; +3; -1.25; 1e+300 ;\n");
}

TEST_F(APointTable, OfNumpyKeepsItsTypeAndLayout) {
  PointTable floats = read(npy<float>("<f4", 2, 3, {1, 2, 3, 4, 5, 6}), "p.npy");
  floats.positions[1].z() = -0.5;
  EXPECT_EQ(bytes_of(floats), npy<float>("<f4", 2, 3, {1, 2, 3, 4, 5, -0.5F}));
  PointTable doubles = read(npy<double>("<f8", 1, 6, {1, 2, 3, 0, 0, 1}), "p.npy");
  doubles.normals[0] = {0.1, 0, 0};
  EXPECT_EQ(bytes_of(doubles), npy<double>("<f8", 1, 6, {1, 2, 3, 0.1, 0, 0}));
  PointTable whole = read(npy<std::int32_t>("<i4", 1, 3, {1, 2, 3}), "p.npy");
  EXPECT_EQ(bytes_of(whole), npy<std::int32_t>("<i4", 1, 3, {1, 2, 3}));
  whole.positions[0].x() = 0.5;
  EXPECT_THAT(error_message<InputError>([&] { bytes_of(whole); }),
              HasSubstr("save the table as floats"));
}

TEST_F(APointTable, WithRowsThatDoNotFitIsRefusedByItsLine) {
  EXPECT_THAT(error("1,2,3,4,5\n"), HasSubstr("p.csv:1: expected 3 numbers (a point x, y, z), 6"));
  EXPECT_THAT(error("1,2,3\n1,2\n"), HasSubstr("p.csv:2: expected 3 numbers, as in the first row"));
  EXPECT_THAT(error("1,2,3\n\n1,nan,3\n"), HasSubstr("p.csv:3: its position is not finite"));
  EXPECT_THAT(error("1,2,3,0,inf,0\n"), HasSubstr("p.csv:1: its normal is not finite"));
  EXPECT_THAT(error("x,y,z\n"), HasSubstr("no row"));
}

}  // namespace
}  // namespace lapwing
