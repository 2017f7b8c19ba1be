#include "lapwing/mesh/shapes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "lapwing/base/limits.h"
#include "lapwing/mesh/subdivide.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

void require_room(double triangles) {
  require_at_most(kMostTriangles, triangles, "the shape would have", "ask for a coarser one");
}

// Adds the square a, b, c, d as two triangles. The diagonal goes from a to c, or from b to d if
// `turned` is true.
void add_square(Mesh& mesh, const std::array<Index, 4>& corners, bool turned = false) {
  const auto& [a, b, c, d] = corners;
  mesh.add_face(std::array{a, b, turned ? d : c});
  mesh.add_face(std::array{turned ? b : a, c, d});
}

// Creates the vertices on the surface of a box of grid points on demand.
class BoxSkin {
 public:
  BoxSkin(Mesh& mesh, Index across, double width, double step)
      : mesh_(mesh), across_(across), width_(width), step_(step) {}

  Index vertex(const std::array<Index, 3>& at) {
    const std::uint64_t key =
        (std::uint64_t{at[2]} * (across_ + 1) + at[1]) * (across_ + 1) + at[0];
    const auto [it, inserted] =
        numbers_.try_emplace(key, static_cast<Index>(mesh_.positions.size()));
    if (inserted) {
      mesh_.positions.emplace_back(width_ * at[0] / across_ - 0.5 * width_,
                                   width_ * at[1] / across_ - 0.5 * width_, step_ * at[2]);
    }
    return it->second;
  }

 private:
  Mesh& mesh_;
  Index across_;
  double width_;
  double step_;
  std::unordered_map<std::uint64_t, Index> numbers_;
};

}  // namespace

Mesh grid(Index columns, Index rows) {
  require_room(2.0 * columns * rows);
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
      const Index d = a + columns + 1;
      add_square(mesh, {a, a + 1, d + 1, d}, (r + c) % 2 != 0);
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
  require_room(2.0 * around * rings);
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
      add_square(mesh, {low + a, low + next, high + next, high + a}, r % 2 == 0);
    }
  }
  return mesh;
}

Mesh rippled_cylinder(Index around, Index rings) {
  constexpr double kHeight = 6.0;
  Mesh mesh = cylinder(around, rings, 0.5, kHeight);
  for (Vector3d& p : mesh.positions) {
    const double angle = std::atan2(p.y(), p.x());
    const double along = 20.0 * std::numbers::pi * p.z() / kHeight;
    p.head<2>() *= 1.0 + 0.03 * std::sin(8.0 * angle) * std::sin(along);
  }
  return mesh;
}

Mesh bumpy_plane(Index cells, Index bumps, double height) {
  Mesh mesh = grid(cells, cells);
  for (Vector3d& p : mesh.positions) {
    const double x = p.x() * bumps;
    const double y = p.y() * bumps;
    // Distance from the centre of the bump, in radii. Its radius is half the side of its square.
    const double r = 2.0 * std::hypot(x - std::floor(x) - 0.5, y - std::floor(y) - 0.5);
    if (r < 1.0) p.z() = 0.5 * height * (1.0 + std::cos(std::numbers::pi * r));
  }
  return mesh;
}

Mesh bar(Index across, Index along, double width, double length) {
  require_room(4.0 * across * (across + 2.0 * along));
  Mesh mesh;
  BoxSkin skin(mesh, across, width, length / along);
  const std::array<Index, 3> size{across, across, along};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (const bool far : {false, true}) {
      const auto corner = [&](Index i, Index j) {
        std::array<Index, 3> at{};
        at[axis] = far ? size[axis] : 0;
        at[u] = i;
        at[v] = j;
        return skin.vertex(at);
      };
      for (Index i = 0; i < size[u]; ++i) {
        for (Index j = 0; j < size[v]; ++j) {
          // The order of the calls matters, because `corner` numbers the vertices it creates.
          const Index a = corner(i, j);
          const Index b = far ? corner(i + 1, j) : corner(i, j + 1);
          const Index c = corner(i + 1, j + 1);
          const Index d = far ? corner(i, j + 1) : corner(i + 1, j);
          add_square(mesh, {a, b, c, d}, (i + j) % 2 != 0);
        }
      }
    }
  }
  return mesh;
}

Mesh torus(Index around, Index across, double radius, double tube_radius) {
  require_room(2.0 * around * across);
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
      add_square(mesh, {a * across + b, a1 * across + b, a1 * across + b1, a * across + b1});
    }
  }
  return mesh;
}

std::span<const NamedShape> named_shapes() {
  static constexpr std::array kShapes{
      NamedShape{"tube", [] { return rippled_cylinder(); }},
      NamedShape{"sphere", [] { return icosphere(5); }},
      NamedShape{"sheet", [] { return grid(100, 100); }},
      NamedShape{"torus", [] { return torus(160, 64, 1.0, 0.4); }},
      // Start shapes of the motions in tools/classics.
      NamedShape{"bumpy-plane", [] { return bumpy_plane(200, 10, 0.03); }},
      NamedShape{"cylinder", [] { return cylinder(48, 100, 0.5, 6.0); }},
      NamedShape{"bar", [] { return bar(16, 96, 1.0, 6.0); }}};
  return kShapes;
}

}  // namespace lapwing
