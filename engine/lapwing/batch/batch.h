#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>

#include "lapwing/batch/result_folder.h"
#include "lapwing/batch/result_writer.h"

namespace lapwing {

/// Many edits: a recipe with values that vary from job to job.
struct BatchRequest {
  std::filesystem::path jobs;         ///< as JobFile reads it
  std::filesystem::path recipe = {};  ///< of jobs that name none
  std::filesystem::path folder;       ///< for what comes out
  BatchOutput output = {};
  bool resume = false;                 ///< go on from what is in the folder
  std::filesystem::path sandbox = {};  ///< what recipes must not leave (JobFile); empty: they may
  std::optional<Shard> shard = {};
  unsigned threads = 0;  ///< 0: as many as there are processors
};

/// How far a batch is; of a shard, that shard.
struct BatchCount {
  std::size_t jobs = 0;
  std::size_t done = 0;    ///< those that were done before among them
  std::size_t before = 0;  ///< done when it began
  std::size_t failed = 0;

  bool is_complete() const { return done + failed == jobs; }
};

/// Who watches a batch; both may be empty.
struct BatchWatch {
  /// Hears of every job that ends, and first of all of those done before. One call at a time.
  std::function<void(const BatchCount&)> count = {};
  /// Asked often, by several threads at once: false ends the batch, without what is in hand.
  std::function<bool()> go_on = {};
};

/// Carries out the jobs, those of one region one after the other by one thread, which prepares once
/// for them (Session); each thread computes by itself, on the processor. What comes out is
/// written as ResultFolder and ResultWriter say, each file in one step and before its line, so that
/// nothing that was done is lost whenever it ends, and is the same to the bit whatever the threads,
/// shards and interruptions, while a thread's memory suffices for exact preparations. A job that
/// fails is a line of failed.jsonl. Complete but for BatchWatch::go_on.
///
/// Throws InputError before anything is run for what JobFile and ResultFolder refuse, and IoError
/// where a file of the batch cannot be read or written; what was done until then stays.
BatchCount run_batch(const BatchRequest& request, const BatchWatch& watch = {});

}  // namespace lapwing
