#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "lapwing/coating/coater.h"
#include "lapwing/coating/correspondence.h"
#include "lapwing/coating/fairing.h"
#include "lapwing/coating/patch_coating.h"
#include "lapwing/coating/sizing_field.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/laplacian/laplacian_system.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/parameterize/domain_locator.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/region/largest_disk.h"
#include "lapwing/step/step.h"
#include "lapwing/vulkan/open_device.h"
#include "run/measure.h"
#include "studies/studies.h"

namespace lapwing::bench {
namespace {

using Eigen::Vector3d;

// A patch and its mesh. A generated source patch has none, because it lies on the target's mesh.
struct Side {
  Mesh mesh;
  VertexSet region;
  double edge_length = 0.0;  // mean
};

struct Pair {
  Side target;
  Side source;              // without a mesh if it lies on the target's
  std::string source_path;  // empty in that case

  const Mesh& source_mesh() const { return source_path.empty() ? target.mesh : source.mesh; }
  const Topology& source_topology() const {
    return source_path.empty() ? target.mesh.topology() : source.mesh.topology();
  }
};

// A square sheet of `across` x `across` vertices, a unit apart.
Mesh sheet(Index across) {
  Mesh mesh = grid(across - 1, across - 1);
  for (Vector3d& p : mesh.positions) p *= across - 1;
  return mesh;
}

// Waves eight and five edges long.
double relief(double x, double y) {
  using std::numbers::pi;
  return 0.8 * std::sin(pi * x / 4.0) * std::sin(pi * y / 4.0) +
         0.2 * std::sin(2.0 * pi * (x + 0.3 * y) / 5.0);
}

// The middle square of the sheet whose first vertex is `first`.
VertexSet middle(Index first, Index across, Index patch_across) {
  const Index margin = (across - patch_across) / 2;
  VertexSet region;
  for (Index r = margin; r < margin + patch_across; ++r) {
    for (Index c = margin; c < margin + patch_across; ++c) region.push_back(first + r * across + c);
  }
  return region;
}

// Returns a sheet with a relief, the source, beside a dome whose odd rows are shifted by half an
// edge.
Pair generated_pair(const CoatBench& settings) {
  const auto root = [](std::size_t count) {
    return static_cast<Index>(std::lround(std::sqrt(static_cast<double>(count))));
  };
  const Index patch_across = root(settings.vertices);
  const Index across = std::max(root(settings.mesh_vertices / 2), patch_across + 2);
  const Mesh source = sheet(across);
  Pair pair;
  Mesh& mesh = pair.target.mesh;
  mesh = sheet(across);
  const double middle_place = 0.5 * (across - 1);
  const double radius = 1.5 * patch_across;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Vector3d& p = mesh.positions[v];
    if ((v / across) % 2 == 1) p.x() += 0.5;
    const Vector3d off = (p - Vector3d(middle_place, middle_place, 0.0)) / radius;
    p.z() = 0.5 * radius * std::exp(-off.squaredNorm());
  }
  const auto first = static_cast<Index>(mesh.vertex_count());
  for (const Vector3d& p : source.positions) {
    mesh.positions.emplace_back(p.x() + 2.0 * across, p.y(), relief(p.x(), p.y()));
  }
  for (const Triangle& t : source.topology().triangles) {
    mesh.add_face(std::array{first + t[0], first + t[1], first + t[2]});
  }
  pair.target.region = middle(0, across, patch_across);
  pair.source.region = middle(first, across, patch_across);
  pair.source.edge_length = 1.0;
  pair.target.edge_length = 1.0;
  return pair;
}

// Returns the largest disk among the `count` vertices nearest to the highest vertex in y.
Side patch_on(const std::string& path, std::size_t count) {
  Side side;
  side.mesh = read_mesh(path);
  const Positions& positions = side.mesh.positions;
  const auto highest =
      std::max_element(positions.begin(), positions.end(),
                       [](const Vector3d& a, const Vector3d& b) { return a.y() < b.y(); });
  const std::array center{static_cast<Index>(highest - positions.begin())};
  const auto distances = geodesic_distances(side.mesh.topology(), positions, center);
  VertexSet nearest(positions.size());
  for (Index v = 0; v < nearest.size(); ++v) nearest[v] = v;
  std::stable_sort(nearest.begin(), nearest.end(),
                   [&](Index a, Index b) { return distances[a] < distances[b]; });
  nearest.resize(std::min(count, nearest.size()));
  side.region = largest_disk(make_vertex_set(std::move(nearest)), side.mesh.topology(), positions);
  side.edge_length = mean_edge_length(side.mesh.topology().rings, positions);
  return side;
}

Pair read_pair(const CoatBench& settings) {
  return {patch_on(settings.target, settings.vertices),
          patch_on(settings.source, settings.vertices), settings.source};
}

// Pairs vertices around the middle of both patches; those of the source are nearer to it.
std::vector<VertexPair> some_inner_pairs(const Patch& source, const DomainMap& source_map,
                                         const Patch& target, const DomainMap& target_map,
                                         std::size_t count) {
  const auto nearest = [](const Patch& patch, const DomainMap& map, const Eigen::Vector2d& place) {
    Index best = 0;
    for (Index own = 0; own < patch.vertices.size(); ++own) {
      if ((map.points[own] - place).norm() < (map.points[best] - place).norm()) best = own;
    }
    return patch.vertices[best];
  };
  std::vector<VertexPair> pairs;
  for (std::size_t p = 0; p < count; ++p) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(p) / static_cast<double>(count);
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    pairs.push_back({nearest(source, source_map, 0.35 * direction),
                     nearest(target, target_map, 0.4 * direction)});
  }
  return pairs;
}

// Measures a coat step, its parts and its sliders.
class CoatBenchRun {
 public:
  CoatBenchRun(const CoatBench& settings, const Pair& pair)
      : settings_(settings),
        pair_(pair),
        detail_(settings.detail_size * pair.source.edge_length),
        source_(disk_patch(pair.source.region, pair.source_topology(), pair.source_mesh().positions,
                           "source")),
        target_(disk_patch(pair.target.region, pair.target.mesh.topology(),
                           pair.target.mesh.positions, "target")) {
    coating_ = peeled(*open_device("cpu").kernels, detail_);
    smooth_ = smooth_target();
    laid_ = on_patch<Vector3d>(target_, smooth_);
    pins_ = {default_pins(source_, coating_.smooth, Domain::disk),
             default_pins(target_, laid_, Domain::disk)};
    source_map_ = mean_value_map(source_, coating_.smooth, Domain::disk, pins_[0]);
    target_map_ = mean_value_map(target_, laid_, Domain::disk, pins_[1]);
    inner_pairs_ =
        some_inner_pairs(source_, source_map_, target_, target_map_, settings.inner_pairs);
  }

  void print_sizes() const;
  void measure_steps(Kernels& kernels, bool smooth_target);
  void measure_sliders(Kernels& kernels);
  void measure_parts();

 private:
  Coating peeled(Kernels& kernels, double detail) const {
    return peel_patch(source_, pair_.source_mesh().positions, pair_.source_topology(), detail,
                      LaplacianWeights::cotangent, kernels);
  }
  Positions smooth_target() const {
    return smooth_around(target_.vertices, target_detail(), pair_.target.mesh.positions,
                         pair_.target.mesh.topology(), LaplacianWeights::cotangent,
                         "smooth_target");
  }
  double target_detail() const { return settings_.detail_size * pair_.target.edge_length; }
  CorrespondenceOptions pairs() const {
    CorrespondenceOptions options;
    options.inner_pairs = inner_pairs_;
    return options;
  }
  CoatStep step(bool smooth_target) const;
  void factor_system() const;
  void solve_maps() const;

  const CoatBench& settings_;
  const Pair& pair_;
  double detail_;
  Patch source_;
  Patch target_;
  Coating coating_;
  Positions smooth_;
  std::vector<Vector3d> laid_;
  std::array<BoundaryPins, 2> pins_;
  DomainMap source_map_;
  DomainMap target_map_;
  std::vector<VertexPair> inner_pairs_;
};

void print_heading(const std::string& title) {
  std::printf("\n| %-36s | %9s | %9s | %9s |\n|%s|----------:|----------:|----------:|\n",
              title.c_str(), "median ms", "min", "max", std::string(38, '-').c_str());
}

void print(const std::string& name, const Samples& samples) {
  std::printf("| %-36s | %9.2f | %9.2f | %9.2f |\n", name.c_str(), samples.median(), samples.min(),
              samples.max());
  std::fflush(stdout);
}

void CoatBenchRun::print_sizes() const {
  std::printf(
      "A source patch of %zu vertices on a mesh of %zu, a target patch of %zu on one of %zu; "
      "detail below %.3g edges; %zu inner pairs\n",
      source_.vertices.size(), pair_.source_mesh().vertex_count(), target_.vertices.size(),
      pair_.target.mesh.vertex_count(), settings_.detail_size, inner_pairs_.size());
}

// The reference for the step: the target's n x n system here, and the two maps in `solve_maps`.
void CoatBenchRun::factor_system() const {
  const Topology& topology = pair_.target.mesh.topology();
  EditRegion region;
  region.roi = target_.vertices;
  region.belt = border_of(target_);
  const Constraints constraints = constraints_of(region, topology, 1.0, true);
  const SystemPattern pattern(topology, region.roi, constraints.unknowns);
  pattern.order();
  StageTimings timings;
  const LaplacianSystem factored(pair_.target.mesh.positions, topology, region.roi, constraints,
                                 pattern, {LaplacianWeights::cotangent, 0.0}, timings);
}

void CoatBenchRun::solve_maps() const {
  mean_value_map(source_, coating_.smooth, Domain::disk, pins_[0]);
  mean_value_map(target_, laid_, Domain::disk, pins_[1]);
}

// Measures each part alone, while nothing else runs.
void CoatBenchRun::measure_parts() {
  const int repeats = settings_.repeats;
  const Mesh& mesh = pair_.target.mesh;
  print_heading("parts, each alone");
  print("disk patch of the source", measure(repeats, [&] {
          disk_patch(pair_.source.region, pair_.source_topology(), pair_.source_mesh().positions,
                     "source");
        }));
  print("disk patch of the target", measure(repeats, [&] {
          disk_patch(pair_.target.region, pair_.target.mesh.topology(), mesh.positions, "target");
        }));
  VertexSet around;
  print("target: grown by the detail size", measure(repeats, [&] {
          around = grown(target_.vertices, target_detail(), pair_.target.mesh.topology(),
                         mesh.positions);
        }));
  std::unique_ptr<Fairing> fairing;
  print("target: fairing analyzed", measure(repeats, [&] {
          fairing = std::make_unique<Fairing>(mesh.positions, pair_.target.mesh.topology(), around,
                                              LaplacianWeights::cotangent);
        }));
  print("target: fairing factored and solved",
        measure(repeats, [&] { fairing->smooth(target_detail()); }));
  print("mean value map of the target",
        measure(repeats, [&] { mean_value_map(target_, laid_, Domain::disk, pins_[1]); }));
  DomainMap bent = source_map_;
  if (!inner_pairs_.empty()) {
    std::vector<PointPull> pulls;
    for (const auto& [from, to] : inner_pairs_) {
      pulls.push_back({source_.own_number(from), target_map_.points[target_.own_number(to)]});
    }
    WarpResult warped;
    print("warp to the inner pairs", measure(repeats, [&] {
            warped = warp_domain(source_.triangles, source_.loop, source_map_.points, pulls);
          }));
    bent.points = warped.points;
  }
  print("flipped triangles of the source",
        measure(repeats, [&] { flipped_triangles(source_.triangles, bent.points); }));
  std::vector<SurfacePoint> points;
  print("location of the target's vertices", measure(repeats, [&] {
          points = DomainLocator(source_.triangles, bent.points).locate(target_map_.points);
        }));
  const auto own = on_patch<Vector3d>(target_, mesh.positions);
  print("look whether to remesh", measure(repeats, [&] {
          SizingField(coating_, target_, own, points).asks_for_remeshing();
        }));
}

CoatStep CoatBenchRun::step(bool smooth_target) const {
  CoatStep step;
  step.source.mesh = pair_.source_path;
  step.source.patch.form = ListedVertices{pair_.source.region};
  step.target_patch.form = ListedVertices{pair_.target.region};
  step.source.detail_size = detail_;
  step.source.inner_pairs = inner_pairs_;
  if (smooth_target) step.parameters.smooth_target = target_detail();
  step.parameters.remesh = Remeshing::none;
  return step;
}

// Measures what the viewer's sliders recompute. The target's system and the map stay.
void CoatBenchRun::measure_sliders(Kernels& kernels) {
  const Correspondence map =
      correspond({source_, coating_.smooth}, {target_, laid_}, pairs(), "coat");
  CoaterOptions options;
  options.transition = {target_detail()};
  options.hold_length = target_detail();
  Coater coater({pair_.target.mesh.positions, smooth_}, pair_.target.mesh.topology(), target_,
                options, kernels);
  coater.take(coating_, map.points, {});
  double amplitude = 0.5;
  print_heading("sliders");
  print("amplitude changed: coat", measure(20 * settings_.repeats, [&] {
          amplitude = 1.5 - amplitude;
          coater.coat(amplitude);
        }));
  Samples peeling;
  Samples taking;
  print("detail size changed: peel and take", measure(settings_.repeats, [&] {
          const Stopwatch watch;
          const Coating other = peeled(kernels, 0.9 * detail_);
          peeling.milliseconds.push_back(watch.elapsed_ms());
          coater.take(other, map.points, {});
          taking.milliseconds.push_back(watch.elapsed_ms() - peeling.milliseconds.back());
        }));
  print("  of it peel", peeling);
  print("  of it take", taking);
}

void CoatBenchRun::measure_steps(Kernels& kernels, bool smooth_target) {
  const CoatStep coat = step(smooth_target);
  std::vector<std::string> order;
  std::map<std::string, Samples> stages;
  Samples total;
  Samples system;
  Samples maps;
  Samples reference;
  // The first run warms up. Step and reference alternate, so that other load slows both.
  for (int run = 0; run <= settings_.repeats; ++run) {
    RunResult result;
    result.mesh = pair_.target.mesh;
    result.original = result.mesh.positions;
    const Stopwatch watch;
    const StepReport report = run_step(coat, {1, "", kernels, {}, result, {}});
    double whole = watch.elapsed_ms();
    const Samples system_now = measure_cold(1, [&] { factor_system(); });
    const Samples maps_now = measure_cold(1, [&] { solve_maps(); });
    if (run == 0) continue;
    system.milliseconds.push_back(system_now.median());
    maps.milliseconds.push_back(maps_now.median());
    reference.milliseconds.push_back(system_now.median() + maps_now.median());
    for (const auto& [name, ms] : report.timings.stages()) {
      if (name == "source") whole -= ms;  // reading
      if (!stages.contains(name)) order.push_back(name);
      stages[name].milliseconds.push_back(ms);
    }
    total.milliseconds.push_back(whole);
  }
  print_heading(std::string("coat step, target ") + (smooth_target ? "smoothed" : "as it is"));
  for (const std::string& name : order) print(name, stages[name]);
  print("whole, but for reading", total);
  print("n x n system of the target", system);
  print("the two parameterizations", maps);
  print("reference: system and the two", reference);
  std::printf("| %-36s | %9.2f |           |           |\n", "whole / reference",
              total.median() / reference.median());
}

}  // namespace

void bench_coat(const CoatBench& settings) {
  const Pair pair = settings.source.empty() ? generated_pair(settings) : read_pair(settings);
  CoatBenchRun run(settings, pair);
  run.print_sizes();
  for (const std::string& device : settings.devices) {
    const auto kernels = open_device(device).kernels;
    std::printf("\nOn %s\n", kernels->device().name.c_str());
    run.measure_steps(*kernels, false);
    run.measure_steps(*kernels, true);
    run.measure_sliders(*kernels);
  }
  run.measure_parts();
}

}  // namespace lapwing::bench
