#include <cmath>
#include <cstdio>

#include "benches.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "measure.h"

namespace lapwing::bench {
namespace {

// A relief whose coordinates have all their digits, as a scan's have.
Mesh relief(std::size_t vertices) {
  const auto side = static_cast<Index>(std::lround(std::sqrt(static_cast<double>(vertices)))) - 1;
  Mesh mesh = grid(side, side);
  for (Eigen::Vector3d& p : mesh.positions) {
    p.z() = 0.1 * std::sin(40.0 * p.x()) * std::cos(31.0 * p.y());
    p *= 1.0 / 3.0;
  }
  return mesh;
}

}  // namespace

void bench_read(std::size_t vertices, int repeats) {
  const Mesh mesh = relief(vertices);
  const auto folder = std::filesystem::temp_directory_path();
  std::printf("%-8s %12s %9s %9s %9s %9s\n", "format", "vertices", "MB", "median ms", "min ms",
              "MB/s");
  for (const char* extension : {".obj", ".ply"}) {
    const auto path = folder / (std::string("lapwing-bench-read") + extension);
    write_mesh(mesh, path);
    const double megabytes = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
    const Samples samples = measure(repeats, [&] { read_mesh(path); });
    std::printf("%-8s %12zu %9.1f %9.1f %9.1f %9.1f\n", extension + 1, mesh.vertex_count(),
                megabytes, samples.median(), samples.min(), megabytes / samples.median() * 1e3);
    std::filesystem::remove(path);
  }
}

}  // namespace lapwing::bench
