#include "lapwing/io/number_table.h"

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/point_table.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Returns the bytes of a .npy file with this type and shape.
std::string npy(const std::string& type, const std::string& shape, const std::string& numbers,
                const std::string& order = "False") {
  std::string header =
      "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }\n";
  std::string bytes = "\x93NUMPY";
  bytes += {'\x01', '\x00', static_cast<char>(header.size()), '\x00'};
  return bytes + header + numbers;
}
template <class Number>
std::string bytes_of(std::initializer_list<Number> numbers) {
  std::string bytes;
  for (const Number number : numbers) {
    const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    bytes.append(raw.begin(), raw.end());
  }
  return bytes;
}

class ANumberTable : public ::testing::Test {
 protected:
  NumberTable read(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return read_number_table(folder_ / name);
  }
  std::string error(const std::string& name, const std::string& bytes) {
    return error_message<InputError>([&] { read(name, bytes); });
  }
  TemporaryFolder folder_;
};

TEST_F(ANumberTable, OfTextMayHaveAHeaderCommentsAndAnySeparator) {
  for (const std::string separator : {",", ", ", ";", "\t", " ", " \t "}) {
    std::string text =
        "\xEF\xBB\xBFvertex|x|y|z\r\n # from the scanner\r\n1|2.5|-3e2|4\r\r\n5|6|7|8|\"9\"";
    for (std::size_t at; (at = text.find('|')) != std::string::npos;) {
      text.replace(at, 1, separator);
    }
    const NumberTable table = read("a.csv", text);
    EXPECT_THAT(table.header, ElementsAre("vertex", "x", "y", "z"));
    ASSERT_EQ(table.row_count(), 2U);
    EXPECT_THAT(table.row(0), ElementsAre(1.0, 2.5, -300.0, 4.0));
    EXPECT_THAT(table.row(1), ElementsAre(5.0, 6.0, 7.0, 8.0, 9.0));
    EXPECT_EQ(table.place(1), (folder_ / "a.csv").string() + ":5");
  }
}

// Returns the error message of number_columns.
std::string column_error(const NumberTable& table) {
  return error_message<InputError>([&] { number_columns(table); });
}

TEST_F(ANumberTable, OfTextNamesTheLineOfWhatIsNoNumber) {
  EXPECT_THAT(column_error(read("a.csv", "1,2,3\n4,five,6\n")),
              HasSubstr("a.csv:2: expected a number in column 2, found \"five\""));
  EXPECT_THAT(column_error(read("a.csv", "O.5,0.5,0.1\n0.2,0.2,0.1\n")),
              HasSubstr("a.csv:1: expected a number in column 1, found \"O.5\""));
  EXPECT_THAT(column_error(read("a.csv", "x,y,z\nmm,mm,mm\n1,2,3\n")),
              HasSubstr("a.csv:2: expected numbers, found \"mm\"; only the first line may name"));
  EXPECT_THAT(column_error(read("a.csv", "1,,3\n")), HasSubstr("a.csv:1: expected a number in "
                                                               "column 2, found nothing"));
  EXPECT_THAT(column_error(read("a.csv", "0,5;0,5;0,1\n")),
              HasSubstr("a.csv:1: expected numbers, found \"0,5\" (write numbers with a decimal "
                        "point, not a comma)"));
  EXPECT_THAT(column_error(read("a.csv", "1;0,5;1\n")),
              HasSubstr("found \"0,5\" (write numbers with a decimal point, not a comma)"));
  EXPECT_THAT(error("a.csv", ""), HasSubstr("the table has no row"));
  EXPECT_THAT(error("a.csv", "x,y\n"), HasSubstr("the table has no row"));
  EXPECT_THAT(error("a.doc", "1,2\n"), HasSubstr("expected a table"));
  EXPECT_THAT(error("a.csv", std::string("\xFF\xFE"
                                         "1\0,\0",
                                         6)),
              HasSubstr("save the table as UTF-8"));
}

TEST_F(ANumberTable, MayHaveTextInItsFirstAndLastColumns) {
  const NumberTable table = read("a.csv", "nose,969,1,2,3,\"left, below\"\nchin,7,4,5,6,\n");
  const NumberColumns columns = number_columns(table);
  EXPECT_THAT(columns.of_row(table, 0), ElementsAre(969.0, 1.0, 2.0, 3.0));
  EXPECT_THAT(columns.of_row(table, 1), ElementsAre(7.0, 4.0, 5.0, 6.0));
  EXPECT_EQ(table.text_at(0, 5), "left, below");
  EXPECT_EQ(table.text_at(0, 1), std::nullopt);
  // The first row is the target of a vertex, the second one that of a point.
  const NumberTable mixed = read("a.csv", "a 969 1 2 3\n\"b c\" 1 2 3 4 5 6 0.5\n");
  EXPECT_THAT(number_columns(mixed).of_row(mixed, 1), ElementsAre(1, 2, 3, 4, 5, 6, 0.5));
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
              HasSubstr("ends before the last of its 2 rows"));
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

class APointTable : public ::testing::Test {
 protected:
  PointTable read(const std::string& text, const std::string& name = "p.csv") {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return read_point_table(folder_ / name);
  }
  std::string error(const std::string& text) {
    return error_message<InputError>([&] { read(text); });
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
  EXPECT_THAT(error("x,y,z\n1,2,3,4\n"), HasSubstr("p.csv:2: expected 3 fields"));
}

TEST_F(APointTable, KeepsItsTextByteForByte) {
  const auto moved = [&](const std::string& text, const std::string& name = "p.csv") {
    PointTable points = read(text, name);
    EXPECT_EQ(points.positions.at(0), Vector3d(1, 2, 3)) << text;
    EXPECT_EQ(bytes_of(points), text);
    points.positions[0] = {1, 0.25, 3};
    return bytes_of(points);
  };
  EXPECT_EQ(moved("name,x,y,z\nM1,1,2,3\n2,4,5,6\n"), "name,x,y,z\nM1,1,0.25,3\n2,4,5,6\n");
  EXPECT_EQ(moved("1,2,3,nose\n4,5,6,\n"), "1,0.25,3,nose\n4,5,6,\n");
  EXPECT_EQ(moved("\"l, \"\"eye\"\"\";1;2;3;0;0;1\n"), "\"l, \"\"eye\"\"\";1;0.25;3;0;0;1\n");
  EXPECT_EQ(moved("\"\",\"x (mm)\",\"Y [mm]\",\"z\"\n\"1\",\"1\",\"2\",\"3\"\n"),
            "\"\",\"x (mm)\",\"Y [mm]\",\"z\"\n\"1\",\"1\",\"0.25\",\"3\"\n");
  EXPECT_EQ(moved("label,l,p,s,defined,description\nF-1,1,2,3,1,\n"),
            "label,l,p,s,defined,description\nF-1,1,0.25,3,1,\n");
  EXPECT_EQ(moved("left eye\t1\t2\t3\n", "p.tsv"), "left eye\t1\t0.25\t3\n");
}

TEST_F(APointTable, OfSlicerHasItsPositions) {
  const std::string head =
      "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n"
      "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
  // Version 5 of Slicer writes two more fields than the header names.
  const std::string last = "vtk_1,4,5,6,0,0,0,1,1,1,0,\"F, 2\",,,2,0\n";
  PointTable points = read(head + "vtk_0,1,2,3,0,0,0,1,1,1,0,F-1\n" + last, "F.fcsv");
  EXPECT_EQ(points.positions, (Positions{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_THAT(points.normals, IsEmpty());
  EXPECT_THAT(points.rotations, IsEmpty());
  points.positions[0].x() = -0.5;
  EXPECT_EQ(bytes_of(points), head + "vtk_0,-0.5,2,3,0,0,0,1,1,1,0,F-1\n" + last);
  EXPECT_THAT(error_message<InputError>([&] { read(head + "vtk_0,1,2\n", "F.fcsv"); }),
              HasSubstr("F.fcsv:4: the row ends before column \"z\""));
}

TEST_F(APointTable, OfSlicerMarkupsHasTheControlPointsThatWerePlaced) {
  const std::string text = R"({"markups": [{"type": "Fiducial", "coordinateSystem": "LPS",
    "controlPoints": [{"label": "F-1", "position": [1.50, 2, -3e0], "orientation": [1, 0, 0]},
      {"label": "F-2", "position": "", "positionStatus": "undefined"},
      {"label": "F-3", "position": [4, 5, 6]}]}, {"type": "Plane"}]})";
  PointTable points = read(text, "F.mrk.json");
  EXPECT_EQ(points.positions, (Positions{{1.5, 2, -3}, {4, 5, 6}}));
  EXPECT_EQ(bytes_of(points), text);
  EXPECT_EQ(points.table.place(1), (folder_ / "F.mrk.json").string() + ":4");
  points.positions[1].y() = 0.25;
  std::string expected = text;
  expected.replace(expected.find("[4, 5, 6]"), 9, "[4, 0.25, 6]");
  EXPECT_EQ(bytes_of(points), expected);

  const auto refused = [&](const std::string& json) {
    return error_message<InputError>([&] { read(json, "F.mrk.json"); });
  };
  EXPECT_THAT(refused(R"({"markups": [{"controlPoints": [{"position": [1, 2]}]}]})"),
              HasSubstr("F.mrk.json:1: expected a position of three numbers"));
  EXPECT_THAT(refused(R"({"markups": [{"controlPoints": [{"position": [1, null, 2]}]}]})"),
              HasSubstr("expected a position of three numbers"));
  EXPECT_THAT(refused(R"({"lapwing": 1})"), HasSubstr("\"markups\" is missing"));
  EXPECT_THAT(refused(R"({"markups": []})"), HasSubstr("no row"));
  EXPECT_THAT(refused("{"), HasSubstr("F.mrk.json"));
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
  PointTable floats = read(npy("<f4", "(2, 3)", bytes_of<float>({1, 2, 3, 4, 5, 6})), "p.npy");
  floats.positions[1].z() = -0.5;
  EXPECT_EQ(bytes_of(floats), npy("<f4", "(2, 3)", bytes_of<float>({1, 2, 3, 4, 5, -0.5F})));
  PointTable doubles = read(npy("<f8", "(1, 6)", bytes_of<double>({1, 2, 3, 0, 0, 1})), "p.npy");
  doubles.normals[0] = {0.1, 0, 0};
  EXPECT_EQ(bytes_of(doubles), npy("<f8", "(1, 6)", bytes_of<double>({1, 2, 3, 0.1, 0, 0})));
  PointTable whole = read(npy("<i4", "(1, 3)", bytes_of<std::int32_t>({1, 2, 3})), "p.npy");
  EXPECT_EQ(bytes_of(whole), npy("<i4", "(1, 3)", bytes_of<std::int32_t>({1, 2, 3})));
  whole.positions[0].x() = 0.5;
  EXPECT_THAT(error_message<InputError>([&] { bytes_of(whole); }),
              HasSubstr("save the table as floats"));
}

TEST_F(APointTable, WithRowsThatDoNotFitIsRefusedByItsLine) {
  EXPECT_THAT(error("1,2,3,4,5\n"), HasSubstr("p.csv:1: expected 3 numbers (a point x, y, z), 6"));
  EXPECT_THAT(error("1,2,3\n1,2\n"), HasSubstr("p.csv:2: expected 3 numbers, as in the first row"));
  EXPECT_THAT(error("1,2,3\n\n1,nan,3\n"), HasSubstr("p.csv:3: its position is not finite"));
  EXPECT_THAT(error("O.5,0.5,0.1\n"), HasSubstr("got 2 and the text \"O.5\""));
  EXPECT_THAT(error("id,x,y,z\n1,2,3\n"), HasSubstr("p.csv:2: expected 4 fields"));
  EXPECT_THAT(error("id,x,y,z\n1,2,3,4\n2,3,?,5\n"),
              HasSubstr("p.csv:3: expected a number in column \"y\", found \"?\"; correct it"));
  EXPECT_THAT(error("1,2,3,0,inf,0\n"), HasSubstr("p.csv:1: its normal is not finite"));
  EXPECT_THAT(error("x,y,z\n"), HasSubstr("no row"));
}

}  // namespace
}  // namespace lapwing
