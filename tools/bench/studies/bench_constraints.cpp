#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <sstream>
#include <string>
#include <sys/resource.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/subdivide.h"
#include "run/apart.h"
#include "run/measure.h"
#include "studies/real/ends_motion.h"
#include "studies/studies.h"

namespace lapwing::bench {
namespace {

using Eigen::Vector3d;

// A mesh with one end held, and the motion that its other vertices should follow: the farther from
// the held end, the more they follow the other end, which leans.
struct LeaningMesh {
  Mesh mesh;
  MovedEnds ends;
  double low = 0.0;
  double high = 0.0;

  explicit LeaningMesh(Mesh of)
      : mesh(std::move(of)), ends(moved_ends(EndsMotion::lean, mesh.positions)) {
    low = mesh.positions[ends.belt.front()].y();
    high = low;
    for (const Vector3d& p : mesh.positions) {
      low = std::min(low, p.y());
      high = std::max(high, p.y());
    }
  }

  Vector3d displacement(Index v) const {
    const Vector3d& p = mesh.positions[v];
    const double share = (p.y() - low) / (high - low);
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

struct EditCost {
  double ms = 0.0;
  double peak_mb = 0.0;
};

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// Runs one edit in a separate process. Its time excludes reading and subdividing.
EditCost run_apart(const ConstraintsBench& settings, const char* name,
                   const std::function<DeformRequest(const LeaningMesh&)>& request) {
  const Told told = run_in_child_process([&](const auto& tell) {
    Mesh mesh = read_mesh(settings.mesh);
    for (int k = 0; k < settings.subdivisions; ++k) {
      mesh = settings.rounded ? loop_subdivide(mesh) : subdivide(mesh);
    }
    const LeaningMesh scene(std::move(mesh));
    const DeformRequest asked = request(scene);
    scene.mesh.topology();
    const Stopwatch watch;
    const Deformed made = deform(scene.mesh, asked);
    std::ostringstream line;
    const Certificate& c = made.certificate;
    line << watch.elapsed_ms() << ' ' << peak_mb() << ' ' << scene.mesh.vertex_count() << ' '
         << c.settle_iterations << ' ' << c.settled << ' '
         << std::max(c.target_error, c.handle_error) / bounds_of(scene.mesh.positions).diagonal()
         << ' ' << c.flipped_triangles << ' ' << 1.0 + c.largest_edge_stretch;
    tell(line.str());
  });
  if (!told.failure.empty()) throw Error(std::string(name) + ": " + told.failure);
  EditCost run;
  std::size_t vertices = 0;
  int iterations = 0;
  bool settled = false;
  double off = 0.0;
  std::size_t flips = 0;
  double edge = 0.0;
  std::istringstream(told.text) >> run.ms >> run.peak_mb >> vertices >> iterations >> settled >>
      off >> flips >> edge;
  std::printf("| %-32s | %8zu | %9.2f | %8.0f | %4d%s | %9.1e | %5zu | %6.2f |\n", name, vertices,
              run.ms / 1000.0, run.peak_mb, iterations, settled ? " " : "!", off, flips, edge);
  std::fflush(stdout);
  return run;
}

void print_ratio(const char* name, const EditCost& run, const EditCost& of) {
  std::printf("| %-32s |          | %9.2f | %8.2f |\n", name, run.ms / of.ms,
              run.peak_mb / of.peak_mb);
}

// Returns how long a window waits for the exact response of the dragged handle.
double preparation_ms(const LeaningMesh& scene, std::size_t handles,
                      const ConstraintsBench& settings, std::unique_ptr<DeformSolver>& kept,
                      CpuKernels& kernels) {
  const DeformRequest request = scene.one_vertex_handles(handles);
  std::vector<HandleSpec> specs;
  for (const MovedHandle& handle : request.handles) specs.push_back({handle.region});
  const EditRegion region = resolve_edit_region(request.roi, request.belt, specs, scene.mesh);
  constexpr std::array<std::size_t, 1> kInHand{0};
  return measure(settings.repeats,
                 [&] {
                   PreparedRegion prepared(scene.mesh.topology());
                   const DragPreview preview(prepared, scene.mesh.positions, region, {}, kInHand);
                   kept = std::make_unique<DeformSolver>(preview, kernels);
                   kept->response_of(kInHand);
                 })
      .median();
}

void measure_window(const ConstraintsBench& settings) {
  const LeaningMesh scene(read_mesh(settings.mesh));
  CpuKernels kernels;
  std::unique_ptr<DeformSolver> deformer;
  const double of_one = preparation_ms(scene, 1, settings, deformer, kernels);
  const double of_many =
      preparation_ms(scene, settings.window_handles, settings, deformer, kernels);
  std::size_t next = 0;
  const Samples grabs = measure(settings.repeats, [&] {
    next = (next + 1) % settings.window_handles;
    deformer->response_of(std::array{next});
  });
  std::printf("\nIn a window, %zu vertices\n", scene.mesh.vertex_count());
  std::printf("  preparation, one pin           %8.1f ms\n", of_one);
  std::printf("  preparation, %4zu pins         %8.1f ms, %.2f times\n", settings.window_handles,
              of_many, of_many / of_one);
  std::printf("  another pin taken in hand      %8.1f ms (%.1f to %.1f)\n", grabs.median(),
              grabs.min(), grabs.max());
}

}  // namespace

void bench_constraints(const ConstraintsBench& settings) {
  std::printf("| %-32s | vertices | seconds   | peak MB  | iter. | off       | flips | edge   |\n",
              "edit");
  const EditCost one = run_apart(settings, "one handle", &LeaningMesh::one_handle);
  const EditCost pin = run_apart(settings, "one one-vertex handle", [](const LeaningMesh& scene) {
    return scene.one_vertex_handles(1);
  });
  const std::string of_pins = std::to_string(settings.handles) + " one-vertex handles";
  const EditCost pins = run_apart(settings, of_pins.c_str(), [&](const LeaningMesh& scene) {
    return scene.one_vertex_handles(settings.handles);
  });
  print_ratio("  beside one handle", pins, one);
  print_ratio("  beside one one-vertex handle", pins, pin);
  const std::string of_marks = std::to_string(settings.landmarks) + " hard landmarks";
  const EditCost marks = run_apart(settings, of_marks.c_str(), [&](const LeaningMesh& scene) {
    return scene.landmarks(settings.landmarks);
  });
  print_ratio("  beside one handle", marks, one);
  if (settings.subdivisions == 0) measure_window(settings);
}

}  // namespace lapwing::bench
