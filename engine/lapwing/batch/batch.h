#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>

#include "lapwing/batch/result_folder.h"
#include "lapwing/batch/result_writer.h"

namespace lapwing {

/// Many edits of one or more recipes with values that vary from job to job.
struct BatchRequest {
  std::filesystem::path jobs = {};    ///< the job file (JobFile)
  std::filesystem::path recipe = {};  ///< recipe of jobs that do not name one
  std::filesystem::path folder = {};  ///< folder for the results
  BatchOutput output = {};
  /// The file for the vertices of all meshes (write_vertex_array), in the order of the jobs. If the
  /// path is empty, no file is written.
  std::filesystem::path vertices = {};
  bool resume = false;                 ///< run only the jobs without a result in the folder
  std::filesystem::path sandbox = {};  ///< the only folder that recipes may use; empty: any folder
  std::optional<Shard> shard = {};
  unsigned threads = 0;  ///< 0: thread_count()
};

/// Progress of a batch, or of a shard.
struct BatchCount {
  std::size_t jobs = 0;
  std::size_t done = 0;    ///< including the jobs done before the run
  std::size_t before = 0;  ///< number of jobs done before the run
  std::size_t failed = 0;

  bool is_complete() const { return done + failed == jobs; }
};

/// Callbacks of a batch; both may be empty.
struct BatchMonitor {
  /// Called at the start and after every job. Calls do not overlap.
  std::function<void(const BatchCount&)> count = {};
  /// Called often, by several threads at once. If it returns false, the batch ends and discards the
  /// jobs in progress.
  std::function<bool()> go_on = {};
};

/// Runs the jobs on the CPU, one job per thread at a time. One thread runs all jobs of a region, so
/// that it prepares the region only once (Session). Each file is written atomically and before the
/// line of its job (ResultFolder, ResultWriter), so an interruption loses no finished job. The
/// results are bitwise identical for any number of threads, shards and interruptions, if every
/// thread has enough memory for exact preparations. A job that fails adds a line to failed.jsonl.
/// The batch is complete unless BatchMonitor::go_on ended it.
///
/// Throws the errors of the constructors of JobFile and ResultFolder before the first job. Throws
/// IoError if a file of the batch cannot be read or written; the results of finished jobs remain.
BatchCount run_batch(const BatchRequest& request, const BatchMonitor& watch = {});

}  // namespace lapwing
