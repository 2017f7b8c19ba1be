#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>

#include "run/blas_kernels.h"
#include "run_command.h"
#include "studies/studies.h"

namespace {

using namespace lapwing::bench;

// The options of the studies: subcommands that measure one thing in detail.
struct Studies {
  int repeats = 7;
  SolveBench solve;
  OrderBench order;
  SettleBench settle;
  RealBench real;
  ConstraintsBench constraints;
  FollowBench follow;
  EditsBench edits;
  CoatBench coat;
#ifdef LAPWING_HAVE_VIEWER
  FrameBench frame;
#endif
};

// Adds the subcommands. Parsing writes to `studies`, which must outlive it.
void add_studies(CLI::App& app, Studies& studies) {
  const auto add_repeats = [&](CLI::App* study) {
    study
        ->add_option("--repeats", studies.repeats,
                     "counted runs of each thing, after one to warm up")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
  };

  auto* solve = app.add_subcommand(
      "solve", "the block Cholesky beside CHOLMOD on the systems of whole meshes");
  add_repeats(solve);
  solve->add_option("MESH", studies.solve.meshes)->required();
  solve->add_option("--subdivide", studies.solve.subdivisions, "split the triangles so many times");
  solve->add_option("--threads", studies.solve.threads, "thread counts to time")->delimiter(',');
  solve
      ->add_option("--anchor-step", studies.solve.anchor_step,
                   "every so many vertices one is anchored")
      ->check(CLI::Range(1, 1'000'000));
  solve->add_flag("--eigen", studies.solve.eigen, "Eigen too (minutes above 30,000 vertices)");
  solve->add_flag("--busy", studies.solve.busy, "also with one processor busy with something else");
  solve->callback([&] {
    studies.solve.repeats = studies.repeats;
    bench_solve(studies.solve);
  });

  auto* order = app.add_subcommand("order", "our nested dissection beside AMD and METIS");
  add_repeats(order);
  order->add_option("MESH", studies.order.meshes);
  order->add_option("--hills", studies.order.hills, "generated sheets of so many vertices a side")
      ->delimiter(',')
      ->check(CLI::Range(2, 4000));
  order->add_option("--subdivide", studies.order.subdivisions, "split the triangles so many times")
      ->check(CLI::Range(0, 4));
  order->callback([&] {
    studies.order.repeats = studies.repeats;
    bench_order(studies.order);
  });

  auto* settle = app.add_subcommand(
      "settle", "detail and lengths kept under large rotations, beside CGAL's ARAP");
  add_repeats(settle);
  settle->add_option("--device", studies.settle.device);
  settle->add_option("--recipes", studies.settle.recipes, "folder of the four test motions")
      ->capture_default_str();
  settle->add_option("--pictures", studies.settle.pictures, "write pictures of all results here");
  settle->callback([&] {
    studies.settle.repeats = studies.repeats;
    bench_settle(studies.settle);
  });

  auto* real = app.add_subcommand(
      "real", "two edits of every real mesh, settled and linear, beside CGAL's ARAP");
  real->add_option("PATH", studies.real.paths, "mesh files, and folders to search for them")
      ->capture_default_str();
  real->add_option("--only", studies.real.only, "only meshes with this in their names");
  real->add_option("--most-vertices", studies.real.most_vertices, "pass over larger meshes");
  real->add_option("--arap-iterations", studies.real.arap_iterations, "of CGAL's, at most")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  real->add_option("--seconds", studies.real.seconds, "that a mesh may take")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  real->add_option("--show", studies.real.show, "what --json wrote: nothing is measured");
  real->add_option("--json", studies.real.json, "write all runs and the summary here");
  real->add_option("--markdown", studies.real.markdown, "write the table of all runs here");
  real->callback([&] { bench_real(studies.real); });

  auto* coat = app.add_subcommand("coat", "a coat step by stages, and what sliders of it cost");
  add_repeats(coat);
  coat->add_option("--vertices", studies.coat.vertices, "of each patch, about")
      ->check(CLI::Range(100, 1'000'000));
  coat->add_option("--mesh-vertices", studies.coat.mesh_vertices, "of the generated mesh");
  auto* source = coat->add_option("--source", studies.coat.source, "mesh of the source patch");
  auto* target = coat->add_option("--target", studies.coat.target, "mesh of the target patch");
  source->needs(target);
  target->needs(source);
  coat->add_option("--detail-size", studies.coat.detail_size, "in edge lengths")
      ->check(CLI::Range(0.1, 1000.0));
  coat->add_option("--inner-pairs", studies.coat.inner_pairs)->check(CLI::Range(0, 100));
  coat->add_option("--devices", studies.coat.devices)->delimiter(',');
  coat->callback([&] {
    studies.coat.repeats = studies.repeats;
    bench_coat(studies.coat);
  });

  auto* follow = app.add_subcommand(
      "follow", "drags settled frame by frame in a given time, and how far they are from settled");
  follow->add_option("MESH", studies.follow.meshes)->required();
  follow->add_option("--subdivide", studies.follow.subdivisions, "so many times")
      ->check(CLI::Range(0, 4));
  follow->add_option("--budget", studies.follow.budget_ms, "milliseconds of a frame")
      ->check(CLI::PositiveNumber);
  follow->add_flag("--at-once", studies.follow.at_once,
                   "drags begin when they can, not a second later");
  follow->add_flag("--again", studies.follow.again,
                   "each is made ready after one with another handle and another belt");
  follow->callback([&] { bench_follow(studies.follow); });

  auto* edits =
      app.add_subcommand("edits", "edits of many regions of a mesh, each prepared anew, by stages");
  edits->add_option("MESH", studies.edits.meshes);
  edits->add_option("--hills", studies.edits.hills, "generated sheets of so many vertices a side")
      ->delimiter(',')
      ->check(CLI::Range(2, 4000));
  edits->add_option("--vertices", studies.edits.vertices, "of a region, at most")
      ->check(CLI::Range(100, 1'000'000))
      ->capture_default_str();
  edits->add_option("--count", studies.edits.count, "edits of each mesh")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  edits->add_flag("--settled", studies.edits.settled, "not by the linear response alone");
  edits->callback([&] { bench_edits(studies.edits); });

  auto* constraints =
      app.add_subcommand("constraints", "what many handles and landmarks cost beside one handle");
  add_repeats(constraints);
  constraints->add_option("MESH", studies.constraints.mesh)->required();
  constraints->add_option("--subdivide", studies.constraints.subdivisions, "so many times")
      ->check(CLI::Range(0, 5));
  constraints->add_flag("--rounded", studies.constraints.rounded,
                        "by Loop's scheme: a smooth surface, not one cut as it lies");
  constraints->add_option("--handles", studies.constraints.handles)->check(CLI::PositiveNumber);
  constraints->add_option("--landmarks", studies.constraints.landmarks)->check(CLI::PositiveNumber);
  constraints->callback([&] {
    studies.constraints.repeats = studies.repeats;
    bench_constraints(studies.constraints);
  });

#ifdef LAPWING_HAVE_VIEWER
  auto* frame = app.add_subcommand("frame", "what a frame of the viewer costs, by parts");
  add_repeats(frame);
  frame->add_option("MESH", studies.frame.mesh)->required();
  frame->add_option("--subdivisions", studies.frame.subdivisions, "of it")->check(CLI::Range(0, 4));
  frame->add_option("--device", studies.frame.device);
  frame->add_option("--width", studies.frame.width)->capture_default_str();
  frame->add_option("--height", studies.frame.height)->capture_default_str();
  frame->add_option("--picture", studies.frame.picture, "write the last frame here (PNG)");
  frame->callback([&] {
    studies.frame.repeats = studies.repeats;
    bench_frame(studies.frame);
  });
#endif
}

}  // namespace

int main(int argc, char** argv) {
  require_fitting_blas(argv);
  CLI::App app(
      "Measures what Lapwing costs, stage by stage over meshes of 1,000 to 1,000,000 vertices, "
      "beside what else does the same work and beside the limits of the device.",
      "lapwing-bench");
  app.require_subcommand(0, 1);
  const RunCommand whole(app);
  Studies studies;
  add_studies(app, studies);
  try {
    app.parse(argc, argv);
    if (!app.get_subcommands().empty()) return 0;
    std::string command_line = "lapwing-bench";
    for (int i = 1; i < argc; ++i) command_line += std::string(" ") + argv[i];
    whole.run(command_line);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lapwing-bench: %s\n", error.what());
    return 1;
  }
}
