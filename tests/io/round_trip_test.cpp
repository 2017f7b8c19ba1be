#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/rich_mesh.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// The data that a format can store in addition to positions and faces.
struct Carried {
  bool uvs, normals, vertex_colors, face_colors, extras, materials, groups, comments;
};

Carried carried_by(const Storage& storage) {
  switch (format_of(storage.name)) {
    case MeshFormat::obj:
      return {true, true, true, false, false, true, true, true};
    case MeshFormat::off:
      return {true, true, true, true, false, false, false, true};
    case MeshFormat::ply:
      return {true, true, true, true, true, false, false, true};
    case MeshFormat::stl:
      return {false, false, false, false, false, false, storage.encoding == Encoding::ascii, false};
    case MeshFormat::glb:
    case MeshFormat::gltf:
      return {true, true, true, false, false, true, false, false};
  }
  return {};
}

std::vector<Eigen::Vector3d> corner_normals(const Mesh& mesh) {
  const MeshAttributes& a = mesh.attributes();
  return at_corners(a.normals, a.has_vertex_normals ? mesh.face_vertices() : a.corner_normals);
}

class RoundTrip : public ::testing::TestWithParam<std::tuple<Storage, Storage>> {};

TEST_P(RoundTrip, KeepsWhatBothFormatsHold) {
  const auto& [first, second] = GetParam();
  const TemporaryFolder folder;
  const Mesh mesh = rich_mesh();
  write_mesh(mesh, folder / first.name, {.encoding = first.encoding});
  const Mesh there = read_mesh(folder / first.name);
  write_mesh(there, folder / ("to-" + second.name), {.encoding = second.encoding});
  const Mesh back = read_mesh(folder / ("to-" + second.name));

  EXPECT_EQ(back.face_starts(), mesh.face_starts());
  EXPECT_EQ(at_corners(back.positions, back.face_vertices()),
            at_corners(mesh.positions, mesh.face_vertices()));

  const Carried a = carried_by(first);
  const Carried b = carried_by(second);
  const MeshAttributes& before = mesh.attributes();
  const MeshAttributes& after = back.attributes();
  if (a.uvs && b.uvs) {
    EXPECT_EQ(at_corners(after.uvs, after.corner_uvs), at_corners(before.uvs, before.corner_uvs));
  }
  if (a.normals && b.normals) {
    EXPECT_EQ(corner_normals(back), corner_normals(there));
  }
  if (a.vertex_colors && b.vertex_colors) {
    EXPECT_EQ(after.vertex_colors, before.vertex_colors);
  }
  if (a.face_colors && b.face_colors) {
    EXPECT_EQ(after.face_colors, before.face_colors);
  }
  if (a.materials && b.materials) {
    EXPECT_EQ(at_corners(after.materials, after.face_materials),
              at_corners(before.materials, before.face_materials));
  }
  if (a.groups && b.groups) {
    EXPECT_EQ(at_corners(after.groups, after.face_groups),
              at_corners(before.groups, before.face_groups));
  }
  if (a.comments && b.comments) {
    EXPECT_EQ(after.comments, before.comments);
  }
  if (a.extras && b.extras) {
    ASSERT_EQ(after.vertex_extras.size(), 1U);
    EXPECT_EQ(after.vertex_extras[0].values, before.vertex_extras[0].values);
    EXPECT_EQ(after.face_extras.at(0).values, before.face_extras[0].values);
  }
}

INSTANTIATE_TEST_SUITE_P(AllPairs, RoundTrip,
                         ::testing::Combine(::testing::ValuesIn(kStorages),
                                            ::testing::ValuesIn(kStorages)));

class Writing : public ::testing::TestWithParam<Storage> {};

TEST_P(Writing, ReportsExactlyWhatTheFormatHasNoPlaceFor) {
  const TemporaryFolder folder;
  const WriteReport report =
      write_mesh(rich_mesh(), folder / GetParam().name, {.encoding = GetParam().encoding});
  const Carried carried = carried_by(GetParam());
  const auto expect = [&](bool is_carried, const std::string& what) {
    if (is_carried) {
      EXPECT_THAT(report.not_carried, Not(Contains(HasSubstr(what)))) << what;
    } else {
      EXPECT_THAT(report.not_carried, Contains(HasSubstr(what))) << what;
    }
  };
  expect(carried.uvs, "texture coordinates (25)");
  expect(carried.normals, "normals");
  expect(carried.vertex_colors, "vertex colours (25)");
  expect(carried.face_colors, "face colours (32)");
  expect(carried.extras, "vertex property 'label' (25)");
  expect(carried.extras, "face property 'quality' (32)");
  expect(carried.materials, "materials (2)");
  expect(carried.groups, "groups (2)");
}

INSTANTIATE_TEST_SUITE_P(All, Writing, ::testing::ValuesIn(kStorages));

TEST(Writing, DoublesReadBackExactly) {
  const TemporaryFolder folder;
  Mesh mesh = grid(2, 2);
  for (auto& p : mesh.positions) p = (p * 1e-3 + Eigen::Vector3d(0.1, 1.0 / 3.0, 1e20)).eval();
  for (const std::string name : {"a.obj", "a.off", "a.ply"}) {
    write_mesh(mesh, folder / name);
    EXPECT_EQ(read_mesh(folder / name).positions, mesh.positions) << name;
  }
}

TEST(Writing, TextureSeamsGoToPlyPerCorner) {
  const TemporaryFolder folder;
  Mesh mesh = grid(1, 1);
  mesh.edit_attributes().uvs = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}};
  mesh.edit_attributes().corner_uvs = {0, 1, 2, 3, 2, 1};
  write_mesh(mesh, folder / "a.ply");
  const MeshAttributes after = read_mesh(folder / "a.ply").attributes();
  EXPECT_EQ(at_corners(after.uvs, after.corner_uvs),
            at_corners(mesh.attributes().uvs, mesh.attributes().corner_uvs));
  EXPECT_THAT(write_mesh(mesh, folder / "a.off").not_carried,
              Contains("texture coordinates (4): OFF cannot store them"));
}

TEST(Writing, InconsistentAttributesAreRefusedByName) {
  const TemporaryFolder folder;
  Mesh mesh = grid(1, 1);
  mesh.edit_attributes().uvs = {{0, 0}};
  mesh.edit_attributes().corner_uvs = {0, 0, 0, 0, 0, 1};
  EXPECT_THAT(error_message<InputError>([&] { write_mesh(mesh, folder / "a.obj"); }),
              HasSubstr("entry 5 of the mesh's corner_uvs is 1"));
}

}  // namespace
}  // namespace lapwing
