#include "kernels/awkward_meshes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "lapwing/mesh/shapes.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;

Mesh triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Mesh mesh;
  mesh.positions = {a, b, c};
  mesh.add_face(std::array<Index, 3>{0, 1, 2});
  return mesh;
}

// Returns a fan around vertex 0. Its `count` other vertices lie on a wavy circle.
Mesh fan(Index count) {
  Mesh mesh;
  mesh.positions.emplace_back(0.1, 0.05, 0.3);
  for (Index k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / count;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.2 * std::sin(3.0 * angle));
    mesh.add_face(std::array<Index, 3>{0, 1 + k, 1 + (k + 1) % count});
  }
  return mesh;
}

// Returns vertex 0 with a one-ring of four vertices, all on one line through vertex 0 and at
// different distances from it.
Mesh collinear_ring() {
  const Vector3d line(1.0, 2.0, 3.0);
  Mesh mesh;
  for (const double t : {0.0, 0.3, -0.7, 1.1, -0.2}) mesh.positions.push_back(t * line);
  mesh.add_face(std::array<Index, 3>{0, 1, 2});
  mesh.add_face(std::array<Index, 3>{0, 3, 4});
  return mesh;
}

Mesh moved(Mesh mesh, const Vector3d& offset) {
  for (Vector3d& p : mesh.positions) p += offset;
  return mesh;
}

Mesh scaled(Mesh mesh, double factor) {
  for (Vector3d& p : mesh.positions) p *= factor;
  return mesh;
}

Mesh with_loose_vertex(Mesh mesh) {
  mesh.positions.emplace_back(3.0, 1.0, -2.0);
  return mesh;
}

Mesh one_vertex() {
  Mesh mesh;
  mesh.positions.emplace_back(1.0, 2.0, 3.0);
  return mesh;
}

}  // namespace

Sample::Sample(std::string sample_name, Mesh sample_mesh)
    : name(std::move(sample_name)),
      mesh(std::move(sample_mesh)),
      topology(mesh.topology()),
      weights(laplacian_weights(topology, mesh.positions, LaplacianWeights::uniform)),
      vertices(mesh.vertex_count()) {
  std::iota(vertices.begin(), vertices.end(), 0U);
}

Mesh rough_sphere(int subdivisions, double amount, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-amount, amount);
  Mesh mesh = icosphere(subdivisions);
  for (Vector3d& p : mesh.positions) {
    p += Vector3d(uniform(generator), uniform(generator), uniform(generator));
  }
  return mesh;
}

std::vector<Sample> awkward_meshes() {
  const Vector3d a(0.2, 0.1, -0.3);
  const Vector3d b(1.1, 0.4, 0.2);
  const Vector3d c(0.3, 0.9, 0.5);
  const Vector3d far(1e4, -1e4, 2e4);
  std::vector<Sample> samples;
  const auto add = [&](const char* name, Mesh mesh) {
    samples.emplace_back(name, std::move(mesh));
  };
  add("no vertex", Mesh());
  add("one vertex", one_vertex());
  add("triangle", triangle(a, b, c));
  add("triangle and loose vertex", with_loose_vertex(triangle(a, b, c)));
  add("ring on a line", collinear_ring());
  add("ring on a line, far away", moved(collinear_ring(), Vector3d(1e4, 2e4, 3e4)));
  add("ring in a point", triangle(a, a, a));
  add("grid with boundary", grid(5, 3));
  add("fan of 40", fan(40));
  add("sphere", icosphere(2));
  add("rough sphere", rough_sphere(2, 0.2, 1));
  add("rough sphere, far away", moved(rough_sphere(2, 0.2, 2), far));
  add("small rough sphere", scaled(rough_sphere(1, 0.2, 3), 1e-3));
  add("large rough sphere", scaled(rough_sphere(1, 0.2, 4), 1e3));
  return samples;
}

}  // namespace lapwing::test
