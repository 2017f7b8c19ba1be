#include <array>
#include <cstdio>
#include <numbers>
#include <optional>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/session/run_recipe.h"
#include "lapwing/vulkan/open_device.h"
#include "run/cgal_arap.h"
#include "run/measure.h"
#include "studies/pictures.h"
#include "studies/studies.h"

namespace lapwing::bench {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

constexpr int kMaxIterations = 200;

// A rippled cylinder, held below z = 0.6, moved above 5.4.
struct Cylinder {
  Mesh mesh = rippled_cylinder();
  Topology topology = mesh.topology();
  EditRegion region;
  std::vector<Index> free;
  std::vector<double> weights =
      laplacian_weights(topology, mesh.positions, LaplacianWeights::uniform);

  Cylinder() {
    region.handles.resize(1);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double z = mesh.positions[v].z();
      region.roi.push_back(v);
      (z < 0.6 ? region.belt : z > 5.4 ? region.handles[0] : free).push_back(v);
    }
  }
};

struct Motion {
  const char* name;
  Affine3d map;
};

// Turns about an axis through the middle of the handle, then moves.
Affine3d turn_and_move(double degrees, const Vector3d& axis, const Vector3d& move) {
  const Vector3d pivot(0.0, 0.0, 5.7);
  return Eigen::Translation3d(pivot + move) *
         Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis) * Eigen::Translation3d(-pivot);
}

// The result of one method.
struct Row {
  std::string name;
  double detail_error = 0.0;         // over the free vertices, as in certificates
  double region_detail_error = 0.0;  // includes belt and handle, and so creases at their borders
  double edge_stretch = 0.0;
  double largest_stretch = 0.0;
  int iterations = 0;
  double frame_ms = 0.0;
  Positions positions = {};
};

void print_heading(const char* title) {
  std::printf("\n%-26s %8s %8s %8s %8s %10s %10s\n", title, "detail", "region", "stretch",
              "largest", "iterations", "frame ms");
}

void print(const Row& row) {
  std::printf("  %-24s %8.3f %8.3f %8.3f %8.3f %10d %10.2f\n", row.name.c_str(), row.detail_error,
              row.region_detail_error, row.edge_stretch, row.largest_stretch, row.iterations,
              row.frame_ms);
  std::fflush(stdout);
}

void print_ratios(const Row& theirs, const Row& ours) {
  std::printf(
      "  %-24s %8.2f %8.2f %8.2f %8.2f %10.2f %10.2f\n", ours.name.c_str(),
      theirs.detail_error / ours.detail_error,
      theirs.region_detail_error / ours.region_detail_error,
      theirs.edge_stretch / ours.edge_stretch, theirs.largest_stretch / ours.largest_stretch,
      static_cast<double>(theirs.iterations) / ours.iterations, theirs.frame_ms / ours.frame_ms);
}

// Measures the results of all methods in the same way.
Row measured(const std::string& name, const Cylinder& cylinder, Positions positions, int iterations,
             const Samples& frame) {
  const auto& [mesh, topology, region, free, weights] = cylinder;
  const EdgeStretches edges = edge_stretches(region.roi, topology, mesh.positions, positions);
  Row row{name,
          detail_error(free, topology, weights, mesh.positions, positions),
          detail_error(region.roi, topology, weights, mesh.positions, positions),
          edges.root_mean_square,
          edges.most.stretch,
          iterations,
          frame.median()};
  row.positions = std::move(positions);
  return row;
}

Row solve_ours(const std::string& name, const Cylinder& cylinder, const Affine3d& motion,
               const DeformOptions& options, Kernels& kernels, int repeats) {
  const DeformSolver deformer(cylinder.mesh.positions, cylinder.topology, cylinder.region, options,
                              kernels);
  DeformResult result;
  const Samples frame = measure(repeats, [&] { result = deformer.solve(std::array{motion}); });
  const Certificate& c = result.certificate;
  return measured(name + (c.settled ? "" : ", cut short"), cylinder, std::move(result.positions),
                  c.settle_iterations, frame);
}

std::vector<Row> solve_ours(const Cylinder& cylinder, const Affine3d& motion, Kernels& kernels,
                            int repeats) {
  DeformOptions rsi;
  rsi.response = LinearResponse::rsi;
  rsi.weights = LaplacianWeights::uniform;
  rsi.settle.reset();
  DeformOptions tangent;
  tangent.settle.reset();
  DeformOptions stiffer;
  stiffer.detail_length *= 0.5;
  return {solve_ours("RSI alone", cylinder, motion, rsi, kernels, repeats),
          solve_ours("tangent alone", cylinder, motion, tangent, kernels, repeats),
          solve_ours("settled", cylinder, motion, {}, kernels, repeats),
          solve_ours("settled, half the length", cylinder, motion, stiffer, kernels, repeats)};
}

std::vector<Row> solve_by_cgal([[maybe_unused]] const Cylinder& cylinder,
                               [[maybe_unused]] const Affine3d& motion,
                               [[maybe_unused]] int repeats) {
  std::vector<Row> rows;
#ifdef LAPWING_HAVE_CGAL
  for (const auto& [name, variant] : {std::pair{"CGAL ARAP", ArapVariant::original},
                                      {"CGAL SRE-ARAP", ArapVariant::smooth_rotations}}) {
    ArapResult result = deform_by_cgal_arap(cylinder.mesh, cylinder.region, std::array{motion},
                                            variant, kMaxIterations, repeats);
    rows.push_back(
        measured(name, cylinder, std::move(result.positions), result.iterations, result.frame));
  }
#endif
  return rows;
}

void draw(const Motion& motion, const Cylinder& cylinder, const std::vector<Row>& rows,
          PictureWriter& pictures) {
  for (const Row& row : rows) {
    pictures.write(std::string(motion.name) + " " + row.name, cylinder.mesh, row.positions,
                   {Vector3d(1.0, -0.3, 0.2), Vector3d::UnitZ()});
  }
}

void bench_cylinder(Kernels& kernels, PictureWriter* pictures, int repeats) {
  const Cylinder cylinder;
  const std::array<Motion, 3> motions{
      {{"bend-90", turn_and_move(90.0, Vector3d::UnitX(), Vector3d(0.0, -1.5, -1.0))},
       {"twist-179", turn_and_move(179.0, Vector3d::UnitZ(), Vector3d::Zero())},
       {"move-2", turn_and_move(0.0, Vector3d::UnitZ(), Vector3d(2.0, 0.0, 0.0))}}};
  std::printf("A rippled cylinder of %zu vertices; belt and handle of weight 1\n",
              cylinder.mesh.vertex_count());
  for (const Motion& motion : motions) {
    print_heading(motion.name);
    const std::vector<Row> ours = solve_ours(cylinder, motion.map, kernels, repeats);
    for (const Row& row : ours) print(row);
    const std::vector<Row> theirs = solve_by_cgal(cylinder, motion.map, repeats);
    for (const Row& row : theirs) print(row);
    for (const Row& row : theirs) {
      std::printf(" %s divided by\n", row.name.c_str());
      print_ratios(row, ours[2]);
      print_ratios(row, ours[3]);
    }
    if (pictures == nullptr) continue;
    draw(motion, cylinder, ours, *pictures);
    draw(motion, cylinder, theirs, *pictures);
  }
}

struct Classic {
  const char* recipe;
  ViewAxes axes;
};

Row row_of(const std::string& name, const RunResult& result) {
  const StepReport& step = result.report.steps.at(0);
  const Certificate& c = step.deform->certificate;
  const auto weights =
      laplacian_weights(result.mesh.topology(), result.original, LaplacianWeights::uniform);
  Row row{name + (c.settled ? "" : ", cut short"),
          c.detail_error,
          detail_error(result.region.roi, result.mesh.topology(), weights, result.original,
                       result.mesh.positions),
          c.edge_stretch,
          c.largest_edge_stretch,
          c.settle_iterations};
  for (const auto& [stage, ms] : step.timings.stages()) {
    if (stage == "solve") row.frame_ms = ms;
  }
  return row;
}

void bench_classics(Kernels& kernels, const std::filesystem::path& recipes,
                    PictureWriter* pictures) {
  const std::array<Classic, 4> classics{
      {{"lift-plane", view_axes(View::three_quarter, UpAxis::z)},
       {"bend-cylinder", {Vector3d(-0.3, -1.0, 0.2), Vector3d::UnitZ()}},
       {"twist-bar", {Vector3d(-0.3, -1.0, 0.2), Vector3d::UnitZ()}},
       {"bend-cactus", {Vector3d(0.2, 0.15, 1.0), Vector3d::UnitY()}}}};
  print_heading("the four test motions");
  for (const Classic& classic : classics) {
    const Recipe recipe = read_recipe(recipes / (std::string(classic.recipe) + ".json"));
    if (!std::filesystem::exists(recipe.mesh_path())) {
      std::printf("  %-24s without its mesh, which tools/classics makes\n", classic.recipe);
      continue;
    }
    const auto result = run_recipe(recipe, kernels);
    print(row_of(classic.recipe, *result));
    if (pictures == nullptr) continue;
    pictures->write(classic.recipe, result->mesh, result->mesh.positions, classic.axes);
  }
}

}  // namespace

void bench_settle(const SettleBench& settings) {
  const auto kernels = open_device(settings.device).kernels;
  std::optional<PictureWriter> pictures;
  if (!settings.pictures.empty()) pictures.emplace(settings.pictures);
  PictureWriter* const maker = pictures ? &*pictures : nullptr;
  bench_cylinder(*kernels, maker, settings.repeats);
  bench_classics(*kernels, settings.recipes, maker);
}

}  // namespace lapwing::bench
