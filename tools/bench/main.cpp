#include <cstdio>
#include <map>

#include <CLI/CLI.hpp>

#include "benches.h"

int main(int argc, char** argv) {
  CLI::App app("Measures what Lapwing costs, beside what else does the same work.",
               "lapwing-bench");
  app.require_subcommand(1);
  app.fallthrough();  // --repeats may stand after the subcommand
  int repeats = 7;
  app.add_option("--repeats", repeats, "counted runs of each thing, after one to warm up")
      ->check(CLI::Range(1, 1000));

  auto* read = app.add_subcommand("read", "reading speed of generated OBJ and binary PLY files");
  std::size_t vertices = 1'000'000;
  read->add_option("--vertices", vertices)
      ->check(CLI::Range(std::size_t{4}, std::size_t{100'000'000}));
  read->callback([&] { lapwing::bench::bench_read(vertices, repeats); });

  auto* deform = app.add_subcommand("deform", "preparation and drag of a whole mesh as region");
  std::string mesh;
  std::string device = "auto";
  deform->add_option("MESH", mesh)->required();
  deform->add_option("--device", device, "auto, cpu, an index or a part of a device's name");
  auto solver = lapwing::SolverKind::automatic;
  const std::map<std::string, lapwing::SolverKind> solvers{
      {"automatic", lapwing::SolverKind::automatic},
      {"block", lapwing::SolverKind::block},
      {"cholmod", lapwing::SolverKind::cholmod},
      {"eigen", lapwing::SolverKind::eigen}};
  deform->add_option("--solver", solver, "automatic, block, cholmod or eigen")
      ->transform(CLI::CheckedTransformer(solvers));
  deform->callback([&] { lapwing::bench::bench_deform(mesh, device, solver, repeats); });

  auto* solve = app.add_subcommand(
      "solve", "the block Cholesky beside CHOLMOD on the systems of whole meshes");
  lapwing::bench::SolveBench settings;
  solve->add_option("MESH", settings.meshes)->required();
  solve->add_option("--subdivide", settings.subdivisions, "split the triangles so many times");
  solve->add_option("--threads", settings.threads, "thread counts to time")->delimiter(',');
  solve->add_option("--anchor-step", settings.anchor_step, "every so many vertices one is anchored")
      ->check(CLI::Range(1, 1'000'000));
  solve->add_flag("--eigen", settings.eigen, "Eigen too (minutes above 30,000 vertices)");
  solve->add_flag("--busy", settings.busy, "also with one processor busy with something else");
  solve->callback([&] {
    settings.repeats = repeats;
    lapwing::bench::bench_solve(settings);
  });

  auto* settle = app.add_subcommand(
      "settle", "detail and lengths kept under large rotations, beside CGAL's ARAP");
  lapwing::bench::SettleBench settle_settings;
  settle->add_option("--device", settle_settings.device);
  settle->add_option("--recipes", settle_settings.recipes, "folder of the four test motions")
      ->capture_default_str();
  settle->add_option("--pictures", settle_settings.pictures, "write pictures of all results here");
  settle->callback([&] {
    settle_settings.repeats = repeats;
    lapwing::bench::bench_settle(settle_settings);
  });

  auto* coat = app.add_subcommand("coat", "a coat step by stages, and what sliders of it cost");
  lapwing::bench::CoatBench coat_settings;
  coat->add_option("--vertices", coat_settings.vertices, "of each patch, about")
      ->check(CLI::Range(100, 1'000'000));
  coat->add_option("--mesh-vertices", coat_settings.mesh_vertices, "of the generated mesh");
  auto* source = coat->add_option("--source", coat_settings.source, "mesh of the source patch");
  auto* target = coat->add_option("--target", coat_settings.target, "mesh of the target patch");
  source->needs(target);
  target->needs(source);
  coat->add_option("--detail-size", coat_settings.detail_size, "in edge lengths")
      ->check(CLI::Range(0.1, 1000.0));
  coat->add_option("--inner-pairs", coat_settings.inner_pairs)->check(CLI::Range(0, 100));
  coat->add_flag("!--no-remesh-check", coat_settings.remesh_check,
                 "leave out the look whether to remesh");
  coat->add_option("--devices", coat_settings.devices)->delimiter(',');
  coat->callback([&] {
    coat_settings.repeats = repeats;
    lapwing::bench::bench_coat(coat_settings);
  });

#ifdef LAPWING_HAVE_VIEWER
  auto* frame = app.add_subcommand("frame", "what a drag frame of the viewer costs, by parts");
  lapwing::bench::FrameBench frame_settings;
  frame->add_option("MESH", frame_settings.mesh)->required();
  frame->add_option("--device", frame_settings.device);
  frame->add_option("--width", frame_settings.width)->capture_default_str();
  frame->add_option("--height", frame_settings.height)->capture_default_str();
  frame->add_option("--picture", frame_settings.picture, "write the last frame here (PNG)");
  frame->callback([&] {
    frame_settings.repeats = repeats;
    lapwing::bench::bench_frame(frame_settings);
  });
#endif

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lapwing-bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
