#include "lapwing/mesh/shapes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

void add_triangle(Mesh& mesh, Index a, Index b, Index c) {
  const std::array<Index, 3> t{a, b, c};
  mesh.add_face(t);
}

}  // namespace

Mesh grid(Index columns, Index rows) {
  Mesh mesh;
  for (Index r = 0; r <= rows; ++r) {
    for (Index c = 0; c <= columns; ++c) {
      mesh.positions.emplace_back(static_cast<double>(c) / columns, static_cast<double>(r) / rows,
                                  0.0);
    }
  }
  for (Index r = 0; r < rows; ++r) {
    for (Index c = 0; c < columns; ++c) {
      const Index a = r * (columns + 1) + c;
      const Index b = a + 1;
      const Index d = a + columns + 1;
      const Index e = d + 1;
      if ((r + c) % 2 == 0) {
        add_triangle(mesh, a, b, e);
        add_triangle(mesh, a, e, d);
      } else {
        add_triangle(mesh, a, b, d);
        add_triangle(mesh, b, e, d);
      }
    }
  }
  return mesh;
}

Mesh icosphere(int subdivisions) {
  Mesh mesh;
  const double t = std::numbers::phi;
  mesh.positions = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                    {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  constexpr std::array<std::array<Index, 3>, 20> kFaces{
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (const auto& f : kFaces) mesh.add_face(f);
  for (int s = 0; s < subdivisions; ++s) mesh = subdivide(mesh);
  for (Vector3d& p : mesh.positions) p.normalize();
  return mesh;
}

Mesh cylinder(Index around, Index rings, double radius, double height) {
  Mesh mesh;
  for (Index r = 0; r < rings; ++r) {
    for (Index a = 0; a < around; ++a) {
      const double angle = 2.0 * std::numbers::pi * (a + 0.5 * (r % 2)) / around;
      mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                  height * r / (rings - 1));
    }
  }
  for (Index r = 0; r + 1 < rings; ++r) {
    for (Index a = 0; a < around; ++a) {
      const Index next = (a + 1) % around;
      const Index low = r * around;
      const Index high = low + around;
      if (r % 2 == 0) {
        add_triangle(mesh, low + a, low + next, high + a);
        add_triangle(mesh, low + next, high + next, high + a);
      } else {
        add_triangle(mesh, low + a, low + next, high + next);
        add_triangle(mesh, low + a, high + next, high + a);
      }
    }
  }
  return mesh;
}

Mesh torus(Index around, Index across, double radius, double tube_radius) {
  Mesh mesh;
  for (Index a = 0; a < around; ++a) {
    const double u = 2.0 * std::numbers::pi * a / around;
    for (Index b = 0; b < across; ++b) {
      const double v = 2.0 * std::numbers::pi * b / across;
      const double r = radius + tube_radius * std::cos(v);
      mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), tube_radius * std::sin(v));
    }
  }
  for (Index a = 0; a < around; ++a) {
    for (Index b = 0; b < across; ++b) {
      const Index a1 = (a + 1) % around;
      const Index b1 = (b + 1) % across;
      add_triangle(mesh, a * across + b, a1 * across + b, a1 * across + b1);
      add_triangle(mesh, a * across + b, a1 * across + b1, a * across + b1);
    }
  }
  return mesh;
}

Mesh subdivide(const Mesh& mesh) {
  Mesh fine;
  fine.positions = mesh.positions;
  std::unordered_map<std::uint64_t, Index> midpoints;
  const auto midpoint = [&](Index a, Index b) {
    const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
    const auto [it, inserted] =
        midpoints.try_emplace(key, static_cast<Index>(fine.positions.size()));
    if (inserted) fine.positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
    return it->second;
  };
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto t = mesh.face(f);
    if (t.size() != 3) {
      throw InputError("face " + std::to_string(f) + " has " + std::to_string(t.size()) +
                       " corners; only triangles can be subdivided");
    }
    const Index a = midpoint(t[0], t[1]);
    const Index b = midpoint(t[1], t[2]);
    const Index c = midpoint(t[2], t[0]);
    add_triangle(fine, t[0], a, c);
    add_triangle(fine, a, t[1], b);
    add_triangle(fine, c, b, t[2]);
    add_triangle(fine, a, b, c);
  }
  return fine;
}

}  // namespace lapwing
