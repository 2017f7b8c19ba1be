#include <array>
#include <ostream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

struct Malformed {
  std::string name;  ///< of the file
  std::string content;
  std::string place;    ///< position in the file, as in the message
  std::string message;  ///< a part of it

  friend void PrintTo(const Malformed& m, std::ostream* out) {
    *out << m.name << m.place << m.message;
  }
};

const std::string kPlyVertices =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kBinaryPly =
    "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list int int vertex_indices\nend_header\n";
const std::string kFirstByte = ": byte " + std::to_string(kBinaryPly.size()) + ":";
const std::string kFirstIndex = ": byte " + std::to_string(kBinaryPly.size() + 4) + ":";
const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

const std::array kMalformed{
    Malformed{"a.obj", "v 1 2\n", ":1:", "expected a coordinate, found the end of the line"},
    Malformed{"a.obj", "v 1 2 x3\n", ":1:", "expected a coordinate, found 'x3'"},
    Malformed{"a.obj", "\r\nv 1 2 3+e1\r\n", ":2:", "found '3+e1'"},
    Malformed{"a.obj", "\rv 1 2\r", ":2:", "expected a coordinate"},
    Malformed{"a.obj", "v 0,5 0 0\n",
              ":1:", "found '0,5' (write numbers with a decimal point, not a comma)"},
    Malformed{"a.off", "OFF\n1 0 0\n1 -2,5e1 0\n", ":3:", "decimal point, not a comma"},
    Malformed{"a.stl", "solid a\nfacet normal 0,0 0 1\nendfacet\n",
              ":2:", "decimal point, not a comma"},
    Malformed{"a.ply", kPlyVertices + "0 0 0\n0,5 0 0\n1 1 1\n3 0 1 2\n",
              ":11:", "decimal point, not a comma"},
    Malformed{"a.off", "NST4OFF\n0 0 0\n", ":1:", "three coordinates per vertex, found 'NST4OFF'"},
    Malformed{"a.off", "CCOFF\n0 0 0\n", ":1:", "a form of it such as 'COFF'"},
    Malformed{"a.obj", "v 1 2 3 4 5\n", ":1:", "x y z r g b or x y z w r g b"},
    Malformed{"a.obj", kTriangle + "f 1 2\n", ":4:", "at least 3 corners, but this one has 2"},
    Malformed{"a.obj", kTriangle + "f 1 2 4\n", ":4:", "vertex 4, but the file has 3"},
    Malformed{"a.obj", kTriangle + "f 0 1 2\n", ":4:", "vertex 0"},
    Malformed{"a.obj", kTriangle + "f -1 -2 -4\n", ":4:", "vertex -4"},
    Malformed{"a.obj", kTriangle + "f 1 2 3z\n", ":4:", "found '3z'"},
    Malformed{"a.obj", kTriangle + "f 1 2 99999999999999999999\n", ":4:", "expected a corner"},
    Malformed{"a.obj", kTriangle + "f 1 \\\n 2 \\\n 9\n", ":6:", "vertex 9"},
    Malformed{"a.obj", "PK stuff\nmore of it\n", ":1:", "expected an OBJ statement"},
    Malformed{"a.obj", std::string("v 1\0 2 3\n", 9), ":1:", "binary data"},
    Malformed{"a.obj", std::string("\xFE\xFF\0v", 4), ":1:", "UTF-16"},
    Malformed{"a.off", "", ":1:", "expected 'OFF'"},
    Malformed{"a.off", "PLY\n", ":1:", "expected 'OFF'"},
    Malformed{"a.off", "4OFF\n0 0 0\n", ":1:", "three coordinates per vertex"},
    Malformed{"a.off", "OFF BINARY\n", ":1:", "binary OFF is not supported"},
    Malformed{"a.off", "OFF\n-3 0 0\n", ":2:", "number of vertices, found '-3'"},
    Malformed{"a.off", "OFF\n900000000000 0 0\n", ":2:", "promises 900000000000 vertices"},
    Malformed{"a.off", "OFF\n1 900000000000 0\n0 0 0\n", ":2:", "900000000000 faces"},
    Malformed{"a.off", "OFF\n1 1 0\n0 0 0\n2 0 0     \n", ":4:", "at least 3 corners"},
    Malformed{"a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n", ":4:", "face 0 names vertex 1"},
    Malformed{"a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 -1\n", ":4:", "vertex -1"},
    Malformed{"a.off", "OFF\n1 2 0\n0 0 0\n3 0 0\n3 0 0 0\n", ":4:", "expected a vertex number"},
    Malformed{"a.off", "OFF\n1 1 0\n0 0 0\n3 0 0    \n",
              ":2:", "1 faces, but the file ends after 0"},
    Malformed{"a.off", "COFF\n1 0 0\n0 0 0 1 1\n", ":3:", "colour of 3 or 4 numbers"},
    Malformed{"a.off", "OFF\n2 0 0\n0 0 0      \n", ":4:", "found the end of the file"},
    Malformed{"a.ply", "plx\n", ":1:", "expected 'ply'"},
    Malformed{"a.ply", "ply\nformat morse 1.0\n", ":2:", "expected 'ascii'"},
    Malformed{"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n", ":4:", "'end_header'"},
    Malformed{"a.ply", "ply\nproperty float x\n", ":2:", "'element' line"},
    Malformed{"a.ply", "ply\nelement v 1\nproperty half x\n", ":3:", "expected a type"},
    Malformed{"a.ply", "ply\nelement v 1\nproperty list float int x\n", ":3:", "integer type"},
    Malformed{"a.ply", "ply\nelement v 1\nproperty float x\nproperty int x\n",
              ":4:", "'x' appears twice"},
    Malformed{"a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n",
              ":3:", "x, y and z"},
    Malformed{"a.ply", "ply\nformat ascii 1.0\nend_header\n", ":3:", "element 'vertex'"},
    Malformed{"a.ply",
              "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
              "property float z\nelement tristrips 0\nproperty int vertex_indices\nend_header\n",
              ":7:", "'list int int vertex_indices' in 'tristrips'"},
    Malformed{"a.ply", kPlyVertices + "0 0 0\n0 0\n1 1 1\n3 0 1 2\n", ":11:", "end of the line"},
    Malformed{"a.ply", kPlyVertices + "0 0 0\n0 0 0 5\n1 1 1\n3 0 1 2\n", ":11:", "found '5'"},
    Malformed{"a.ply", kPlyVertices + "0 0 0\n0 0 0\n1 1 1\n3 0 1 3\n", ":13:", "vertex 3"},
    Malformed{"a.ply", kPlyVertices + "0 0 0\n0 0 0\n1 1 1\n2 0 1\n", ":13:", "at least 3 corners"},
    Malformed{"a.ply", kPlyVertices + "0 0 0\n0 0 0\n1 1 1\n-3 0 1\n", ":13:", "-3 entries"},
    Malformed{"a.ply", kPlyVertices + "0 0 0\n0 0 0\n1 1 1\n70000 0 1\n0\n",
              ":13:", "70000 entries"},
    Malformed{"a.ply", kPlyVertices + "0 0 0\n", ":3:", "promises 3 'vertex' records"},
    Malformed{"a.ply", kBinaryPly + std::string("\3\0\0\0\0\0\0\0\0\0", 10), kFirstByte,
              "1 faces, but the file ends after 0"},
    Malformed{"a.ply", kBinaryPly + "\x7F\x7F\x7F\x7F" + std::string(12, '\0'), kFirstByte,
              "2139062143 entries"},
    Malformed{"a.ply", kBinaryPly + std::string("\3\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 16),
              kFirstIndex, "face 0 names vertex 0"},
    Malformed{"a.stl", "solid a\nfacet normal 0 0\nendfacet\n", ":2:", "expected a coordinate"},
    Malformed{"a.stl", "solid a\nfacet normal 0 0 1\nouter lop\nendfacet\n",
              ":3:", "expected loop, found 'lop'"},
    Malformed{"a.stl", "solid a\nendsolid\nfacet normal 0 0 1\n",
              ":3:", "expected solid, found 'facet'"},
    Malformed{"a.stl", "solid a\nfact\n", ":2:", "expected 'facet' or 'endsolid', found 'fact'"},
    Malformed{"a.stl", "solid a\n", ":2:", "found the end of the file"},
    Malformed{"a.stl", "hello\n", ": byte 0:", "starts with 'solid'"},
    Malformed{"a.stl", std::string(80, 'x') + std::string("\7\0\0\0", 4) + std::string(60, 'y'),
              ": byte 80:", "promises 7 triangles, but the file's size fits 1"},
};

class MalformedFile : public ::testing::TestWithParam<Malformed> {};

TEST_P(MalformedFile, IsRefusedWithThePlaceAndTheExpectation) {
  const TemporaryFolder folder;
  const auto path = folder.file(GetParam().name, GetParam().content);
  EXPECT_THAT(error_message<InputError>([&] { read_mesh(path); }),
              AllOf(HasSubstr(path.string() + GetParam().place), HasSubstr(GetParam().message),
                    HasSubstr("export the file again")));
}

INSTANTIATE_TEST_SUITE_P(All, MalformedFile, ::testing::ValuesIn(kMalformed));

TEST(MalformedFile, UnknownExtensionNamesTheKnownOnes) {
  EXPECT_THAT(error_message<InputError>([&] { read_mesh("mesh.fbx"); }),
              AllOf(HasSubstr("mesh.fbx"), HasSubstr(".obj, .off, .ply, .stl, .gltf or .glb")));
}

TEST(MalformedFile, MissingFileGivesTheSystemsReason) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_message<IoError>([&] { read_mesh(folder / "none.obj"); }),
              AllOf(HasSubstr("none.obj"), HasSubstr("No such file")));
}

}  // namespace
}  // namespace lapwing
