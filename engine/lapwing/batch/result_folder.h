#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "lapwing/batch/job_file.h"
#include "lapwing/batch/line_file.h"

namespace lapwing {

/// The K-th of N parts of a batch, as even as they can be; `number` from 1 to `count`.
struct Shard {
  std::size_t number = 1;
  std::size_t count = 1;
};

/// What a batch has come to in its folder: a line for each job that is done in results.jsonl, and
/// for each that failed in failed.jsonl, whose names say so where they are a shard's
/// (results-2-of-8.jsonl). While it runs the lines come as the jobs end; at the end they are in the
/// order of the jobs. Threads may add lines at once.
class ResultFolder {
 public:
  /// Of `jobs`, those of `shard` if there is one; both must outlive it. Makes the folder if it is
  /// not there. With `resume` it takes over what results of any shard have of these jobs, and
  /// removes what was written of a file when a run was killed. Throws InputError without `resume`
  /// where there are results already, and IoError.
  ResultFolder(std::filesystem::path folder, std::span<const Job> jobs, std::optional<Shard> shard,
               bool resume);

  /// Throws InputError if `read` is a file that such a folder is to hold.
  static void require_no_result(const std::filesystem::path& folder,
                                const std::filesystem::path& read);

  const std::filesystem::path& path() const { return folder_; }
  /// Whether a result says that this job, from 0, was carried out as it is asked for now, and the
  /// files that it names are there.
  bool is_done(std::size_t job) const { return done_[job] != 0; }

  /// Adds what became of a job. Throws IoError.
  void add_result(std::size_t job, const std::string& line);
  void add_failure(const std::string& line);

  /// Puts the lines in order, once nothing is left to do. Whoever has no shard removes the files of
  /// all shards, whose lines it has. Throws IoError, with all lines still there.
  void finish();

 private:
  bool counts(std::string_view line, std::size_t& job) const;
  void take_over(const std::filesystem::path& file);
  void remove_leftovers() const;
  void put_in_order(const std::filesystem::path& file, bool is_result) const;

  std::filesystem::path folder_;
  std::span<const Job> jobs_;
  bool is_whole_;  ///< no shard
  std::filesystem::path results_path_;
  std::filesystem::path failed_path_;
  std::unordered_map<std::string_view, std::size_t> job_of_;  ///< by id
  std::vector<char> done_;
  std::mutex mutex_;
  std::unique_ptr<LineFile> results_;
  std::unique_ptr<LineFile> failed_;  ///< null until something fails
};

}  // namespace lapwing
