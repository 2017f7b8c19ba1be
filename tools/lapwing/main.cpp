#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "examples.h"
#include "lapwing/base/errors.h"
#include "messages.h"
#include "usage_error.h"

namespace lapwing::cli {
namespace {

constexpr const char* kOutOfMemory = "out of memory; choose a smaller region of interest";

// Prints the requested help to standard output, or the error to standard error. Returns the exit
// code.
int exit_of(CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error, std::cout);
  say(usage_message(app, error));
  return kUsage;
}

int fail(ExitCode code, const std::exception& error) {
  say(error.what());
  return code;
}

int run(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return kDone;
  } catch (const CLI::ParseError& error) {
    return exit_of(app, error);
  } catch (const ExitWith& exit) {
    return exit.code;
  } catch (const Cancelled&) {
    say("cancelled; nothing was written");
    return kCancelled;
  } catch (const InputError& error) {
    return fail(kInput, error);
  } catch (const SolverError& error) {
    return fail(kSolver, error);
  } catch (const GpuError& error) {
    return fail(kDevice, error);
  } catch (const IoError& error) {
    return fail(kFile, error);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(kFile, error);
  } catch (const std::bad_alloc&) {
    say(kOutOfMemory);
    return kSolver;
  } catch (const std::exception& error) {
    say(std::string("a bug in the program: ") + error.what() + "; please report it");
    return kFault;
  }
}

// Called if an exception cannot be caught, for example if a destructor of a library runs out of
// memory. In this case, prints a message and exits without a core file.
[[noreturn]] void on_terminate() {
  try {
    if (const auto exception = std::current_exception()) std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "lapwing: %s\n", kOutOfMemory);
    std::_Exit(kSolver);
  } catch (...) {
  }
  std::abort();
}

// Flushes standard output. Returns kFile if this fails, for example on a full disk; otherwise
// returns `code`.
int with_output(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.flush()) return code;
  say(std::string("cannot write to standard output: ") + std::strerror(errno) +
      "; all other files are written");
  return code == kDone ? kFile : code;
}

}  // namespace
}  // namespace lapwing::cli

int main(int argc, char** argv) {
  using namespace lapwing::cli;
  std::set_terminate(on_terminate);
  CLI::App app("Laplacian surface editing: moves a part of a mesh and keeps its detail.",
               "lapwing");
  app.set_version_flag("--version", LAPWING_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 a bug in the program, 2 usage, 3 mesh or recipe, 4 solver (or\n"
      "--strict), 5 device, 6 file, 130 cancelled (Ctrl+C), 143 ended by a signal.\n"
      "`lapwing COMMAND --help` lists the options of a command.");
  for (const auto add : {add_run, add_batch, add_steps, add_keys, add_peel, add_wrap, add_transfer,
                         add_cut, add_parts, add_render, add_check, add_convert, add_info,
                         add_shape, add_subdivide, add_remesh, add_parameterize}) {
    add(app);
  }
  add_examples(app);
  return with_output(run(app, argc, argv));
}
