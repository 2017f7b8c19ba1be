#include "lapwing/io/number_table.h"

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ANumberTable : public ::testing::Test {
 protected:
  NumberTable read(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return read_number_table(folder_ / name);
  }
  std::string error(const std::string& name, const std::string& bytes) {
    return error_message<InputError>([&] { read(name, bytes); });
  }
  static std::string npy(const std::string& type, const std::string& shape,
                         const std::string& numbers, const std::string& order = "False") {
    std::string header =
        "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }\n";
    std::string bytes = "\x93NUMPY";
    bytes += {'\x01', '\x00', static_cast<char>(header.size()), '\x00'};
    return bytes + header + numbers;
  }
  template <class Number>
  static std::string bytes_of(std::initializer_list<Number> numbers) {
    std::string bytes;
    for (const Number number : numbers) {
      const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
      bytes.append(raw.begin(), raw.end());
    }
    return bytes;
  }

  TemporaryFolder folder_;
};

TEST_F(ANumberTable, OfTextMayHaveAHeaderCommentsAndAnySeparator) {
  const NumberTable table = read(
      "a.csv", "\xEF\xBB\xBFvertex,x,y,z\r\n# from the scanner\r\n1, 2.5,-3e2,4\r\n\n5;6\t7 8 9");
  ASSERT_EQ(table.row_count(), 2U);
  EXPECT_THAT(table.row(0), ElementsAre(1.0, 2.5, -300.0, 4.0));
  EXPECT_THAT(table.row(1), ElementsAre(5.0, 6.0, 7.0, 8.0, 9.0));
  EXPECT_EQ(table.place(1), (folder_ / "a.csv").string() + ":5");
}

TEST_F(ANumberTable, OfTextNamesTheLineOfWhatIsNoNumber) {
  EXPECT_THAT(error("a.csv", "1,2,3\n4,five,6\n"),
              HasSubstr("a.csv:2: expected a number, found \"five\""));
  EXPECT_THAT(error("a.csv", "1,two\n"), HasSubstr("a.csv:1: expected a number"));
  EXPECT_THAT(error("a.csv", ""), HasSubstr("the table has no row"));
  EXPECT_THAT(error("a.csv", "x,y\n"), HasSubstr("the table has no row"));
  EXPECT_THAT(error("a.doc", "1,2\n"), HasSubstr("expected a table"));
}

TEST_F(ANumberTable, OfNumpyHoldsAnyNumbers) {
  const NumberTable doubles =
      read("a.npy", npy("<f8", "(2, 2)", bytes_of<double>({1.5, -2.0, 3.0, 4.0})));
  ASSERT_EQ(doubles.row_count(), 2U);
  EXPECT_THAT(doubles.row(0), ElementsAre(1.5, -2.0));
  EXPECT_THAT(doubles.row(1), ElementsAre(3.0, 4.0));
  EXPECT_THAT(doubles.place(1), HasSubstr("a.npy, row 1"));
  EXPECT_THAT(read("b.npy", npy("<f4", "(1, 2)", bytes_of<float>({0.5F, -8.0F}))).row(0),
              ElementsAre(0.5, -8.0));
  EXPECT_THAT(read("c.npy", npy("<i8", "(1, 2)", bytes_of<std::int64_t>({-7, 1234567}))).row(0),
              ElementsAre(-7.0, 1234567.0));
  EXPECT_THAT(read("d.npy", npy("|u1", "(1, 2)", "\x07\xFF")).row(0), ElementsAre(7.0, 255.0));
  EXPECT_THAT(read("e.npy", npy(">i2", "(1, 1)", "\xFF\xFE")).row(0), ElementsAre(-2.0));
}

TEST_F(ANumberTable, OfNumpySaysWhatIsWrong) {
  EXPECT_THAT(error("a.npy", "1,2,3"), HasSubstr("not an NPY file"));
  EXPECT_THAT(error("a.npy", npy("<f8", "(2, 2)", bytes_of<double>({1.0}))),
              HasSubstr("ends within its 2 rows"));
  EXPECT_THAT(error("a.npy", npy("<f8", "(2,)", bytes_of<double>({1.0, 2.0}))),
              HasSubstr("two dimensions"));
  EXPECT_THAT(error("a.npy", npy("<f8", "(1, 1, 1)", bytes_of<double>({1.0}))),
              HasSubstr("two dimensions"));
  EXPECT_THAT(error("a.npy", npy("<f8", "(1, 1)", bytes_of<double>({1.0}), "True")),
              HasSubstr("Fortran order"));
  EXPECT_THAT(error("a.npy", npy("<c16", "(1, 1)", bytes_of<double>({1.0, 2.0}))),
              HasSubstr("expected floats or integers"));
  EXPECT_THAT(error("a.npy", npy("<f8", "(99999999, 4)", "")), HasSubstr("more than 5000000 rows"));
  EXPECT_THAT(error("a.npy", npy("<f8", "(0, 4)", "")), HasSubstr("no row"));
  EXPECT_THAT(error("a.npy", npy("<f8", "(1, 1)", "").substr(0, 20)),
              HasSubstr("within its header"));
}

TEST_F(ANumberTable, IsMissedByItsName) {
  EXPECT_THAT(error_message<IoError>([&] { read_number_table(folder_ / "none.csv"); }),
              HasSubstr("none.csv"));
}

}  // namespace
}  // namespace lapwing
