#include "run/subject.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/subdivide.h"

namespace lapwing::bench {
namespace {

using Eigen::Vector3d;

constexpr const char* kHills = "hills";

// A scan and its number of vertices, so that a run need not read the files that it leaves out.
struct Scan {
  const char* name;
  const char* file;
  std::size_t vertices;
  int subdivisions;
};
constexpr std::array kScans{
    Scan{"cow", "cow.off", 2904, 0},
    Scan{"homer", "homer.off", 4930, 0},
    Scan{"lion-head", "lion-head.off", 8356, 0},
    Scan{"camel", "camel.off", 9770, 0},
    Scan{"armadillo", "armadillo.off", 26002, 0},
    Scan{"bunny", "bunny00.off", 37706, 0},
    Scan{"elephant", "refined_elephant.off", 44460, 0},
    Scan{"armadillo x 4", "armadillo.off", 104002, 1},
    Scan{"armadillo x 16", "armadillo.off", 416002, 2},
};
// Vertices per side, for about 1,000, 10,000, 100,000, 250,000 and 1,000,000 vertices.
constexpr std::array<Index, 5> kHillsAcross{32, 100, 316, 500, 1000};

// Returns a sheet of `across` x `across` vertices at distances of 1, with hills of width 30 and a
// fine relief. The wavelengths do not depend on the size of the sheet.
Mesh hills(Index across) {
  using std::numbers::pi;
  Mesh mesh = grid(across - 1, across - 1);
  for (Vector3d& p : mesh.positions) {
    p *= across - 1;
    p.z() = 4.0 * std::sin(pi * p.x() / 30.0) * std::sin(pi * p.y() / 30.0) +
            0.5 * std::sin(pi * p.x() / 4.0) * std::sin(pi * p.y() / 4.0);
  }
  return mesh;
}

EditRegion whole_mesh_region(const Mesh& mesh) {
  std::vector<Index> by_height(mesh.vertex_count());
  std::iota(by_height.begin(), by_height.end(), 0U);
  EditRegion region;
  region.roi = by_height;
  std::stable_sort(by_height.begin(), by_height.end(),
                   [&](Index a, Index b) { return mesh.positions[a].y() < mesh.positions[b].y(); });
  const auto share = static_cast<std::ptrdiff_t>(mesh.vertex_count() / 20);
  region.belt.assign(by_height.begin(), by_height.begin() + share);
  region.handles.emplace_back(by_height.end() - share, by_height.end());
  std::sort(region.belt.begin(), region.belt.end());
  std::sort(region.handles[0].begin(), region.handles[0].end());
  return region;
}

std::filesystem::path path_of(const Scan& scan, const std::filesystem::path& models) {
  return models / "cgal/meshes" / scan.file;
}

}  // namespace

Eigen::Affine3d Subject::motion(double share) const {
  const Vector3d shift(0.1 * diagonal * share, 0.05 * diagonal * share, 0.0);
  return Eigen::Translation3d(shift) *
         Eigen::AngleAxisd(0.3 * share, Vector3d(1.0, 2.0, 3.0).normalized());
}

double frame_budget_ms(std::size_t vertices) {
  constexpr std::size_t kSmall = 50'000;
  constexpr std::size_t kMedium = 250'000;
  return vertices <= kSmall ? 8.0 : vertices <= kMedium ? 16.0 : 100.0;
}

std::array<Eigen::Affine3d, 1> MovingHandle::next() {
  const double turn = 2.0 * std::numbers::pi * ++frames_ / kFramesOfMotion;
  return {subject_.motion(0.5 - 0.5 * std::cos(turn))};
}

Subject SubjectSource::load() const {
  Subject subject;
  subject.name = name;
  subject.mesh = make();
  subject.mesh.topology();  // once for all stages
  subject.region = whole_mesh_region(subject.mesh);
  subject.diagonal = bounds_of(subject.mesh.positions).diagonal();
  subject.has_relief = name == kHills;
  return subject;
}

std::vector<SubjectSource> all_subjects(const std::filesystem::path& models) {
  std::vector<SubjectSource> subjects;
  for (const Scan& scan : kScans) {
    const std::filesystem::path path = path_of(scan, models);
    if (!std::filesystem::exists(path)) continue;
    subjects.push_back({scan.name, scan.vertices, [path, times = scan.subdivisions] {
                          Mesh mesh = read_mesh(path);
                          for (int i = 0; i < times; ++i) mesh = loop_subdivide(mesh);
                          return mesh;
                        }});
  }
  for (const Index across : kHillsAcross) {
    subjects.push_back({kHills, std::size_t{across} * across, [across] { return hills(across); }});
  }
  std::stable_sort(subjects.begin(), subjects.end(),
                   [](const auto& a, const auto& b) { return a.vertices < b.vertices; });
  return subjects;
}

std::vector<std::string> missing_scans(const std::filesystem::path& models, std::size_t least,
                                       std::size_t most) {
  std::vector<std::string> names;
  for (const Scan& scan : kScans) {
    const bool is_wanted = least <= scan.vertices && scan.vertices <= most;
    if (is_wanted && !std::filesystem::exists(path_of(scan, models))) names.emplace_back(scan.name);
  }
  return names;
}

}  // namespace lapwing::bench
