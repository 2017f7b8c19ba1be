#include <cstdio>
#include <filesystem>
#include <new>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "exit_code.h"
#include "lapwing/base/errors.h"

namespace lapwing::cli {
namespace {

int run(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return kDone;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kUsage;
  } catch (const ExitWith& exit) {
    return exit.code;
  } catch (const Cancelled&) {
    std::fprintf(stderr, "lapwing: cancelled; nothing was written\n");
    return kCancelled;
  } catch (const InputError& error) {
    std::fprintf(stderr, "lapwing: %s\n", error.what());
    return kInput;
  } catch (const SolverError& error) {
    std::fprintf(stderr, "lapwing: %s\n", error.what());
    return kSolver;
  } catch (const GpuError& error) {
    std::fprintf(stderr, "lapwing: %s\n", error.what());
    return kDevice;
  } catch (const IoError& error) {
    std::fprintf(stderr, "lapwing: %s\n", error.what());
    return kFile;
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "lapwing: %s\n", error.what());
    return kFile;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "lapwing: out of memory; choose a smaller region of interest\n");
    return kSolver;
  }
}

}  // namespace
}  // namespace lapwing::cli

int main(int argc, char** argv) {
  CLI::App app("Laplacian surface editing: moves a part of a mesh and keeps its detail.",
               "lapwing");
  app.set_version_flag("--version", LAPWING_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 2 usage, 3 mesh or recipe, 4 solver (or --strict), 5 device, 6 file.\n"
      "`lapwing COMMAND --help` tells what a command takes.");
  lapwing::cli::add_run(app);
  lapwing::cli::add_batch(app);
  lapwing::cli::add_steps(app);
  lapwing::cli::add_keys(app);
  lapwing::cli::add_peel(app);
  lapwing::cli::add_cut(app);
  lapwing::cli::add_parts(app);
  lapwing::cli::add_render(app);
  lapwing::cli::add_check(app);
  lapwing::cli::add_convert(app);
  lapwing::cli::add_info(app);
  lapwing::cli::add_shape(app);
  lapwing::cli::add_subdivide(app);
  lapwing::cli::add_remesh(app);
  lapwing::cli::add_parameterize(app);
  return lapwing::cli::run(app, argc, argv);
}
