#include <algorithm>
#include <cstdio>
#include <functional>
#include <sstream>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/base/memory_use.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/deform.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/subdivide.h"
#include "run/apart.h"
#include "studies/ends_motion.h"
#include "studies/studies.h"

namespace lapwing::bench {
namespace {

using Eigen::Vector3d;

// A mesh with one end held, and the motion that its other vertices should follow: the farther from
// the held end, the more they follow the other end, which leans.
struct LeaningMesh {
  Mesh mesh;
  MovedEnds ends;
  Bounds bounds;

  explicit LeaningMesh(Mesh of)
      : mesh(std::move(of)),
        ends(moved_ends(EndsMotion::lean, mesh.positions)),
        bounds(bounds_of(mesh.positions)) {}

  Vector3d displacement(Index v) const {
    const Vector3d& p = mesh.positions[v];
    const double share = (p.y() - bounds.min.y()) / (bounds.max.y() - bounds.min.y());
    return share * share * (ends.map * p - p);
  }

  // Returns `count` vertices off the belt, at even steps of their numbers.
  std::vector<Index> chosen(std::size_t count) const {
    VertexSet all(mesh.vertex_count());
    for (Index v = 0; v < all.size(); ++v) all[v] = v;
    const VertexSet off_belt = subtract(all, ends.belt);
    std::vector<Index> vertices;
    for (std::size_t k = 0; k < count; ++k) {
      vertices.push_back(off_belt[k * off_belt.size() / count]);
    }
    return vertices;
  }

  DeformRequest held() const {
    DeformRequest request;
    request.roi = {AllVertices{}, "roi"};
    request.belt = RegionSpec{ListedVertices{ends.belt}, "belt"};
    return request;
  }
  DeformRequest one_handle() const {
    DeformRequest request = held();
    request.handles = {
        {{ListedVertices{ends.handle}, "handle"}, MatrixMove{ends.map.matrix().topRows<3>()}}};
    return request;
  }
  DeformRequest one_vertex_handles(std::size_t count) const {
    DeformRequest request = held();
    for (const Index v : chosen(count)) {
      request.handles.push_back(
          {{ListedVertices{{v}}, "handle"}, SimilarityMove{.translate = displacement(v)}});
    }
    return request;
  }
  DeformRequest landmarks(std::size_t count) const {
    DeformRequest request = held();
    request.targets.hard = true;
    for (const Index v : chosen(count)) {
      request.targets.rows.push_back({v, mesh.positions[v] + displacement(v)});
    }
    return request;
  }
};

// Runs one edit in a separate process. Prints its time and the ratio of this time to `beside_ms`,
// the time of another edit. Returns the time, which excludes reading and subdividing the mesh.
double print_edit(const ConstraintsBench& settings, const std::string& name, double beside_ms,
                  const std::function<DeformRequest(const LeaningMesh&)>& request) {
  const Told told = run_in_child_process([&](const auto& tell) {
    Mesh mesh = read_mesh(settings.mesh);
    for (int k = 0; k < settings.subdivisions; ++k) mesh = subdivide(mesh);
    const LeaningMesh scene(std::move(mesh));
    const DeformRequest asked = request(scene);
    scene.mesh.topology();
    const Stopwatch watch;
    const Certificate c = deform(scene.mesh, asked).certificate;
    const double ms = watch.elapsed_ms();
    std::printf("%-24s %9zu %9.2f %8.2f %8.0f %6d%s %9.1e %6zu %8.2f\n", name.c_str(),
                scene.mesh.vertex_count(), ms / 1e3, beside_ms > 0.0 ? ms / beside_ms : 1.0,
                static_cast<double>(peak_memory_bytes()) / 1e6, c.settle_iterations,
                c.settled ? " " : "!",
                std::max(c.target_error, c.handle_error) / scene.bounds.diagonal(),
                c.flipped_triangles, 1.0 + c.largest_edge_stretch);
    std::fflush(stdout);
    tell(std::to_string(ms));
  });
  if (!told.failure.empty()) throw Error(name + ": " + told.failure);
  return std::stod(told.text);
}

}  // namespace

void bench_constraints(const ConstraintsBench& settings) {
  std::printf("%-24s %9s %9s %8s %8s %7s %9s %6s %8s\n", "edit", "vertices", "seconds", "ratio",
              "peak MB", "iter.", "off", "flips", "edge");
  const double one = print_edit(settings, "one handle", 0.0, &LeaningMesh::one_handle);
  print_edit(settings, std::to_string(settings.handles) + " one-vertex handles", one,
             [&](const LeaningMesh& scene) { return scene.one_vertex_handles(settings.handles); });
  print_edit(settings, std::to_string(settings.landmarks) + " hard landmarks", one,
             [&](const LeaningMesh& scene) { return scene.landmarks(settings.landmarks); });
}

}  // namespace lapwing::bench
