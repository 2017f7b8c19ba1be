#include <csignal>
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/counted.h"
#include "lapwing/base/errors.h"
#include "lapwing/batch/batch.h"
#include "lapwing/batch/result_folder.h"
#include "messages.h"
#include "progress_display.h"

namespace lapwing::cli {
namespace {

volatile std::sig_atomic_t caught = 0;

void on_signal(int signal) {
  caught = signal;
  // A second signal ends the program immediately.
  std::signal(signal, SIG_DFL);
}

// Parses text such as "2/8".
Shard shard_of(const std::string& text) {
  Shard shard;
  char beyond = 0;
  const bool is_read =
      std::sscanf(text.c_str(), "%zu/%zu%c", &shard.number, &shard.count, &beyond) == 2;
  if (!is_read || shard.number < 1 || shard.number > shard.count) {
    throw CLI::ValidationError("--shard",
                               "expected K/N, such as 2/8 for the second of eight, got " + text);
  }
  return shard;
}

struct BatchOptions {
  BatchRequest request;
  std::string shard;
  std::string displacements;
  bool quiet = false;

  void run();
};

void BatchOptions::run() {
  if (!shard.empty()) request.shard = shard_of(shard);
  if (!displacements.empty()) {
    request.output.displacements = displacements == "float32" ? Scalar::float32 : Scalar::float64;
  }
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  // If a file exceeds the size limit, report an error instead of ending the program.
  std::signal(SIGXFSZ, SIG_IGN);
  BatchDisplay display(quiet);
  BatchCount count;
  try {
    count = run_batch(
        request, {[&](const BatchCount& now) { display.show(now); }, [] { return caught == 0; }});
  } catch (const InputError& error) {
    say(error.what());
    throw ExitWith{kUsage};
  }
  display.finish(count);
  if (count.is_complete() && !request.vertices.empty() && !quiet) {
    std::printf("wrote %s\n", shown(request.vertices).c_str());
  }
  if (count.failed > 0) {
    say(counted(count.failed, "jobs") + " failed; see " +
        ResultFolder::failed_file(request.folder, request.shard).string());
  }
  if (!count.is_complete()) {
    say("interrupted; continue with --resume");
    throw ExitWith{kSignalled + caught};
  }
  if (count.failed > 0) throw ExitWith{kInput};
}

}  // namespace

void add_batch(CLI::App& app) {
  auto* command =
      app.add_subcommand("batch", "run many edits: a recipe whose values vary, line by line");
  auto options = std::make_shared<BatchOptions>();
  BatchRequest& request = options->request;
  command
      ->add_option("JOBS", request.jobs,
                   R"(one job per line: {"id": ID, "recipe": FILE, "set": {JSON POINTER: VALUE}})")
      ->required();
  command
      ->add_option("-o,--output", request.folder,
                   "the folder for the results, results.jsonl and failed.jsonl")
      ->required();
  command->add_option("--recipe", request.recipe, "the recipe of jobs that name none");
  command->add_flag("--resume", request.resume,
                    "continue from the results of all shards in the folder; repeat failed jobs");
  command->add_option("--sandbox", request.sandbox,
                      "refuse recipes that read or write outside this folder");
  command->add_option("--shard", options->shard,
                      "K/N: run the K-th of N parts of the jobs, for several machines");
  auto* format = command
                     ->add_option("--format", request.output.extension,
                                  "format of the meshes; by default that of the recipe's "
                                  "\"save\", or ply")
                     ->check(CLI::IsMember({"ply", "obj", "off", "stl", "glb", "gltf"}));
  command
      ->add_option("--displacements", options->displacements,
                   "write numpy arrays (n, 3) instead of meshes, and one rest.ply")
      ->check(CLI::IsMember({"float32", "float64"}))
      ->excludes(format);
  command
      ->add_option("--vertices", request.vertices,
                   "also write the vertices of all results to this .npy file: float64, of shape "
                   "(jobs, n, 3); NaN if a job failed")
      ->excludes("--shard")
      ->excludes("--displacements");
  command->add_option("--threads", request.threads, "number of threads; by default all processors")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--quiet", options->quiet, "print errors only");
  command->callback([options] { options->run(); });
}

}  // namespace lapwing::cli
