#include <cstdio>

#include <CLI/CLI.hpp>

#include "benches.h"

int main(int argc, char** argv) {
  CLI::App app("Measures what Lapwing costs, beside what else does the same work.",
               "lapwing-bench");
  app.require_subcommand(1);
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
  deform->callback([&] { lapwing::bench::bench_deform(mesh, device, repeats); });

  app.fallthrough();
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
