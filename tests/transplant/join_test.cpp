#include "lapwing/transplant/join.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/rich_mesh.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/compact.h"
#include "support/error_message.h"
#include "transplant/loop_scenes.h"

namespace lapwing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Attributes of every kind, told apart by `name` and `number`.
void enrich(Mesh& mesh, const std::string& name, float number) {
  MeshAttributes& a = mesh.edit_attributes();
  a.has_vertex_normals = true;
  a.corner_uvs = mesh.face_vertices();
  ExtraAttribute label{"label", "int", 1, {}};
  ExtraAttribute pair{"pair of " + name, "double", 2, {}};
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    a.uvs.emplace_back(number, static_cast<double>(v));
    a.normals.emplace_back(0.0, 0.0, 1.0);
    a.vertex_colors.emplace_back(0.2F * number, 1.0F, 0.0F, 1.0F);
    label.values.push_back(100.0 * number + static_cast<double>(v));
    pair.values.insert(pair.values.end(), {1.5 * number, static_cast<double>(v)});
  }
  a.vertex_extras = {label, pair};
  ExtraAttribute quality{"quality", "double", 1, {}};
  for (Index f = 0; f < mesh.face_count(); ++f) {
    a.face_colors.emplace_back(0.2F * number, static_cast<float>(f % 2), 1.0F, 1.0F);
    a.face_materials.push_back(f % 2);
    a.face_groups.push_back(0);
    quality.values.push_back(number);
  }
  a.face_extras = {quality};
  a.materials = {"wool", name};
  a.groups = {"all of it"};
  a.comments = {"made by a test", name};
  a.material_libraries = {name + ".mtl"};
}

struct Pair {
  test::Rim host = test::hole_in_sheet(8, test::circle(1.0));
  test::Rim part = test::flat_part(6, test::circle(0.5));
  Bridge bridge = test::bridge(host, part);
  Joined join(const std::string& group = "wing") const {
    return lapwing::join(host.mesh, host.loop, part.mesh, part.loop, bridge, group);
  }
};

Pair rich_pair() {
  Pair pair;
  enrich(pair.host.mesh, "host", 1.0F);
  enrich(pair.part.mesh, "part", 2.0F);
  return pair;
}

TEST(Join, PutsHostPartAndStripOneAfterTheOther) {
  const Pair pair;
  const Joined joined = pair.join();
  EXPECT_EQ(joined.mesh.vertex_count(), 16U + 12U);
  EXPECT_EQ(joined.mesh.face_count(), 16U + 12U + 14U);
  EXPECT_THAT(joined.strip_faces, SizeIs(14));
  EXPECT_EQ(joined.strip_faces.front(), 28U);
  for (Index v = 0; v < 12; ++v) {
    EXPECT_EQ(joined.mesh.positions[joined.part_vertices[v]], pair.part.mesh.positions[v]);
  }
}

TEST(Join, CarriesEveryAttributeOfBoth) {
  const Pair pair = rich_pair();
  const Joined joined = pair.join();
  const Mesh& mesh = joined.mesh;
  const MeshAttributes& a = mesh.attributes();
  ASSERT_NO_THROW(validate_attributes(mesh));
  const MeshAttributes& of_part = pair.part.mesh.attributes();
  for (Index v = 0; v < 12; ++v) {
    const Index there = joined.part_vertices[v];
    EXPECT_EQ(a.vertex_colors[there], of_part.vertex_colors[v]);
    EXPECT_EQ(a.vertex_extras.at(0).values[there], of_part.vertex_extras[0].values[v]);
    EXPECT_EQ(a.vertex_extras.at(2).values[2 * there + 1], v);
  }
  for (std::size_t c = 0; c < pair.part.mesh.face_vertices().size(); ++c) {
    const Index uv = a.corner_uvs[pair.host.mesh.face_vertices().size() + c];
    EXPECT_EQ(a.uvs.at(uv), of_part.uvs[of_part.corner_uvs[c]]);
  }
  EXPECT_TRUE(a.has_vertex_normals);
  EXPECT_THAT(a.materials, ElementsAre("wool", "host", "part"));
  EXPECT_THAT(a.material_libraries, ElementsAre("host.mtl", "part.mtl"));
  EXPECT_THAT(a.comments, ElementsAre("made by a test", "host", "part"));
  EXPECT_EQ(a.face_materials[16], 0U);
  EXPECT_EQ(a.face_materials[17], 2U);
  EXPECT_THAT(joined.notes, Contains(HasSubstr("material 'wool'")));
  EXPECT_THAT(joined.notes, Contains(HasSubstr("the part has no vertex property 'pair of host'")));
}

TEST(Join, StripFacesLookLikeTheFacesBehindThem) {
  const Pair pair = rich_pair();
  const Joined joined = pair.join();
  const MeshAttributes& a = joined.mesh.attributes();
  for (std::size_t k = 0; k < joined.strip_faces.size(); ++k) {
    const Index face = joined.strip_faces[k];
    const bool on_host = pair.bridge.triangles[k][0] < 8;
    EXPECT_EQ(a.face_extras.at(0).values[face], on_host ? 1.0 : 2.0);
    EXPECT_EQ(a.face_colors[face].x(), on_host ? 0.2F : 0.4F);
    for (std::size_t c = 0; c < 3; ++c) {
      const Index corner = joined.mesh.face_starts()[face] + static_cast<Index>(c);
      const Eigen::Vector2d uv = a.uvs.at(a.corner_uvs[corner]);
      EXPECT_EQ(uv.x(), on_host ? 1.0 : 2.0);
      // The texture coordinates number the vertices of each mesh.
      const Index vertex = joined.mesh.face_vertices()[corner];
      if (c == 2) continue;
      EXPECT_EQ(uv.y(), on_host ? vertex : vertex - 16);
    }
  }
}

TEST(Join, GroupsNameThePart) {
  const Joined joined = rich_pair().join("wing");
  const MeshAttributes& a = joined.mesh.attributes();
  EXPECT_THAT(a.groups, ElementsAre("all of it", "wing", "wing/all of it"));
  EXPECT_EQ(a.face_groups[0], 0U);
  EXPECT_EQ(a.face_groups[16], 2U);
  EXPECT_EQ(a.face_groups[28], 1U);
  const Joined plain = Pair().join("wing");
  EXPECT_THAT(plain.mesh.attributes().groups, ElementsAre("wing"));
  EXPECT_EQ(plain.mesh.attributes().face_groups[0], kNoIndex);
  EXPECT_EQ(plain.mesh.attributes().face_groups[16], 0U);
  EXPECT_THAT(Pair().join("").mesh.attributes().face_groups, IsEmpty());
}

TEST(Join, WhatOnlyOneHasIsNeutralOnTheOther) {
  Pair pair;
  enrich(pair.part.mesh, "part", 2.0F);
  const Joined joined = pair.join();
  const MeshAttributes& a = joined.mesh.attributes();
  ASSERT_NO_THROW(validate_attributes(joined.mesh));
  EXPECT_EQ(a.vertex_colors[3], Eigen::Vector4f::Ones());
  EXPECT_EQ(a.face_materials[3], kNoIndex);
  EXPECT_EQ(a.corner_uvs[3], kNoIndex);
  EXPECT_EQ(a.vertex_extras.at(0).values[3], 0.0);
  EXPECT_EQ(a.normals.at(3), Eigen::Vector3d::UnitZ());  // the sheet's own
  EXPECT_THAT(joined.notes, Contains(HasSubstr("the host has no texture coordinates")));
  EXPECT_THAT(Pair().join().notes, IsEmpty());
}

TEST(Join, NormalsPerCornerComeFromBothSides) {
  Pair pair = rich_pair();
  MeshAttributes& a = pair.host.mesh.edit_attributes();
  a.has_vertex_normals = false;
  a.normals = {Eigen::Vector3d::UnitX()};
  a.corner_normals.assign(pair.host.mesh.face_vertices().size(), 0);
  const Joined joined = pair.join();
  const MeshAttributes& after = joined.mesh.attributes();
  ASSERT_NO_THROW(validate_attributes(joined.mesh));
  for (std::size_t c = 0; c < joined.mesh.face_vertices().size(); ++c) {
    const bool on_host = joined.mesh.face_vertices()[c] < 16;
    EXPECT_EQ(after.normals.at(after.corner_normals.at(c)),
              on_host ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ());
  }
}

TEST(Join, WeldedVerticesAreTheHosts) {
  Pair pair;
  pair.part = test::upright_part(
      8, [](double angle) { return Eigen::Vector3d(test::circle(1.0, 1e-3)(angle)); });
  enrich(pair.host.mesh, "host", 1.0F);
  enrich(pair.part.mesh, "part", 2.0F);
  pair.bridge = test::bridge(pair.host, pair.part);
  ASSERT_THAT(pair.bridge.welded, SizeIs(8));
  const Joined joined = pair.join();
  EXPECT_EQ(joined.mesh.vertex_count(), 16U + 8U);
  EXPECT_THAT(joined.strip_faces, IsEmpty());
  EXPECT_THAT(test::manifold_faults(joined.mesh), IsEmpty());
  for (Index k = 0; k < 8; ++k) {
    const Index v = joined.part_vertices[k];
    ASSERT_LT(v, 8U);
    EXPECT_EQ(joined.mesh.positions[v].z(), 0.0);
    EXPECT_EQ(joined.mesh.attributes().vertex_colors[v].x(), 0.2F);
  }
}

TEST(Join, PolygonsStayPolygons) {
  Pair pair;
  for (test::Rim* rim : {&pair.host, &pair.part}) {
    const auto count = static_cast<Index>(rim->loop.size());
    rim->mesh.edit_faces().starts = {0};
    rim->mesh.edit_faces().vertices.clear();
    for (Index k = 0; k < count; ++k) {
      const Index next = (k + 1) % count;
      rim->mesh.add_face(std::array{k, next, count + next, count + k});
    }
  }
  pair.bridge = test::bridge(pair.host, pair.part);
  const Joined joined = pair.join();
  ASSERT_EQ(joined.mesh.face_count(), 8U + 6U + 14U);
  for (Index f = 0; f < 14; ++f) EXPECT_EQ(joined.mesh.face(f).size(), 4U);
  for (const Index f : joined.strip_faces) EXPECT_EQ(joined.mesh.face(f).size(), 3U);
  EXPECT_THAT(test::manifold_faults(joined.mesh), IsEmpty());
}

TEST(Join, WrittenAndReadBackItIsTheSameMesh) {
  Mesh mesh = rich_pair().join().mesh;
  mesh.edit_attributes().vertex_extras.resize(1);  // no format has a place for pairs
  const TemporaryFolder folder;
  for (const std::string name : {"a.obj", "a.ply"}) {
    write_mesh(mesh, folder / name);
    const Mesh back = read_mesh(folder / name);
    EXPECT_EQ(back.positions, mesh.positions) << name;
    EXPECT_EQ(back.face_starts(), mesh.face_starts()) << name;
    EXPECT_EQ(back.face_vertices(), mesh.face_vertices()) << name;
    EXPECT_EQ(at_corners(back.attributes().uvs, back.attributes().corner_uvs),
              at_corners(mesh.attributes().uvs, mesh.attributes().corner_uvs))
        << name;
    EXPECT_EQ(back.attributes().vertex_colors, mesh.attributes().vertex_colors) << name;
    if (name == "a.ply") {
      EXPECT_EQ(back.attributes().face_colors, mesh.attributes().face_colors);
      ASSERT_THAT(back.attributes().vertex_extras, SizeIs(1));
      EXPECT_EQ(back.attributes().face_extras.at(0).values,
                mesh.attributes().face_extras[0].values);
    } else {
      EXPECT_EQ(at_corners(back.attributes().groups, back.attributes().face_groups),
                at_corners(mesh.attributes().groups, mesh.attributes().face_groups));
      EXPECT_EQ(at_corners(back.attributes().materials, back.attributes().face_materials),
                at_corners(mesh.attributes().materials, mesh.attributes().face_materials));
    }
  }
}

TEST(Join, ALoopThatIsNotTheMeshsIsRefused) {
  Pair pair;
  std::swap(pair.host.loop[0], pair.host.loop[1]);
  EXPECT_THAT(error_message<InputError>([&] { pair.join(); }),
              HasSubstr("the host's loop goes from vertex 1 to vertex 0"));
}

}  // namespace
}  // namespace lapwing
