#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"

namespace lapwing {
namespace {

constexpr unsigned kSeeds = 300;

// Adds every fixable kind of defect at random positions.
class Vandal {
 public:
  explicit Vandal(unsigned seed) : random_(seed) {}

  Mesh broken_mesh() {
    Mesh mesh = shape();
    for (Index times = below(12) + 1; times > 0; --times) damage(mesh);
    tag(mesh);
    return mesh;
  }

 private:
  Index below(std::size_t count) { return static_cast<Index>(random_() % count); }
  Index vertex(const Mesh& mesh) { return below(mesh.vertex_count()); }
  Index corner(const Mesh& mesh) { return below(mesh.face_vertices().size()); }

  Mesh shape() {
    switch (below(4)) {
      case 0:
        return grid(4, 3);
      case 1:
        return icosphere(1);
      case 2:
        return cylinder(5, 4, 1.0, 2.0);
      default:
        return torus(6, 5, 2.0, 0.5);
    }
  }

  void damage(Mesh& mesh) {
    switch (below(10)) {
      case 0:
        return unweld(mesh);
      case 1:
        return merge_vertices(mesh);
      case 2:
        return flip_face(mesh);
      case 3:
        return repeat_face(mesh);
      case 4:
        return add_random_polygon(mesh);
      case 5:
        return repeat_corner(mesh);
      case 6:
        mesh.positions[vertex(mesh)].y() = std::numeric_limits<double>::quiet_NaN();
        return;
      case 7:
        mesh.positions.emplace_back(9, 9, below(2));
        return;
      case 8:
        return turn_inside_out(mesh);
      default:
        mesh.positions[vertex(mesh)] = mesh.positions[vertex(mesh)];
        return;
    }
  }

  // Replaces the vertex of random corners by a new copy of it.
  void unweld(Mesh& mesh) {
    for (Index times = below(20); times > 0; --times) {
      const Index c = corner(mesh);
      mesh.positions.push_back(mesh.positions[mesh.face_vertices()[c]]);
      mesh.edit_faces().vertices[c] = static_cast<Index>(mesh.vertex_count() - 1);
    }
  }

  void merge_vertices(Mesh& mesh) {
    const Index from = vertex(mesh);
    std::ranges::replace(mesh.edit_faces().vertices, from, vertex(mesh));
  }

  void flip_face(Mesh& mesh) {
    const Index f = below(mesh.face_count());
    Faces& faces = mesh.edit_faces();
    std::reverse(faces.vertices.begin() + faces.starts[f],
                 faces.vertices.begin() + faces.starts[f + 1]);
  }

  void repeat_face(Mesh& mesh) {
    const auto face = mesh.face(below(mesh.face_count()));
    std::vector<Index> copy(face.begin(), face.end());
    std::ranges::shuffle(copy, random_);
    mesh.add_face(copy);
  }

  void add_random_polygon(Mesh& mesh) {
    std::vector<Index> polygon(below(7));
    for (Index& v : polygon) v = vertex(mesh);
    mesh.add_face(polygon);
  }

  void repeat_corner(Mesh& mesh) {
    mesh.edit_faces().vertices[corner(mesh)] = mesh.face_vertices()[corner(mesh)];
  }

  // Adds attributes that store the original vertex, corner and face.
  void tag(Mesh& mesh) {
    MeshAttributes& a = mesh.edit_attributes();
    a.uvs.assign(mesh.face_vertices().size(), Eigen::Vector2d::Zero());
    for (Index c = 0; c < mesh.face_vertices().size(); ++c) a.corner_uvs.push_back(c);
    for (Index f = 0; f < mesh.face_count(); ++f) a.face_materials.push_back(f);
    a.vertex_extras = {{"id", "int", 1, {}}};
    for (Index v = 0; v < mesh.vertex_count(); ++v) a.vertex_extras[0].values.push_back(v);
  }

  std::mt19937 random_;
};

template <typename Body>
void for_each_broken_mesh(Body&& body) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Mesh broken = Vandal(seed).broken_mesh();
    Mesh fixed = broken;
    const FixReport report = fix(fixed);
    body(broken, fixed, report);
  }
}

TEST(FixProperty, TheseMeshesNeedEveryRepair) {
  std::array<bool, kRepairKindCount> seen{};
  for_each_broken_mesh([&](const Mesh&, const Mesh&, const FixReport& report) {
    for (const Repair& repair : report.repairs) seen[static_cast<std::size_t>(repair.kind)] = true;
  });
  EXPECT_THAT(seen, ::testing::Each(true));
}

TEST(FixProperty, LeavesNoFixableDefect) {
  for_each_broken_mesh([](const Mesh&, const Mesh& fixed, const FixReport&) {
    for (const Defect& defect : check(fixed).defects) {
      EXPECT_FALSE(describe(defect.kind).fixable) << describe(defect.kind).key;
    }
  });
}

TEST(FixProperty, ChangesAMeshExactlyWhenItHasAFixableDefect) {
  for_each_broken_mesh([](const Mesh& broken, const Mesh&, const FixReport& report) {
    EXPECT_EQ(check(broken).is_fixable(), report.changed());
  });
}

TEST(FixProperty, SecondFixDoesNothing) {
  for_each_broken_mesh([](const Mesh&, const Mesh& fixed, const FixReport&) {
    Mesh again = fixed;
    EXPECT_FALSE(fix(again).changed());
    EXPECT_EQ(again.face_vertices(), fixed.face_vertices());
  });
}

TEST(FixProperty, VerticesKeepTheirPositionsAndAttributes) {
  for_each_broken_mesh([](const Mesh& broken, const Mesh& fixed, const FixReport& report) {
    ASSERT_EQ(report.vertex_sources.size(), fixed.vertex_count());
    for (std::size_t v = 0; v < fixed.vertex_count(); ++v) {
      const Index source = report.vertex_sources[v];
      EXPECT_EQ(fixed.positions[v], broken.positions[source]);
      EXPECT_EQ(fixed.attributes().vertex_extras[0].values[v], source);
    }
  });
}

TEST(FixProperty, CornersStayWhereTheirUvsAndMaterialsAre) {
  for_each_broken_mesh([](const Mesh& broken, const Mesh& fixed, const FixReport&) {
    for (std::size_t f = 0; f < fixed.face_count(); ++f) {
      const Index old_face = fixed.attributes().face_materials[f];
      for (Index c = fixed.face_starts()[f]; c < fixed.face_starts()[f + 1]; ++c) {
        const Index old_corner = fixed.attributes().corner_uvs[c];
        EXPECT_GE(old_corner, broken.face_starts()[old_face]);
        EXPECT_LT(old_corner, broken.face_starts()[old_face + 1]);
        EXPECT_EQ(fixed.positions[fixed.face_vertices()[c]],
                  broken.positions[broken.face_vertices()[old_corner]]);
      }
    }
  });
}

}  // namespace
}  // namespace lapwing
