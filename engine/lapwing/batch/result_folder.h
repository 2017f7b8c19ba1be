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

/// Part `number`, from 1 to `count`, of a batch that is divided into `count` parts of nearly equal
/// size.
struct Shard {
  std::size_t number = 1;
  std::size_t count = 1;
};

/// The results of a batch: one line in results.jsonl for each job that is done, and one line in
/// failed.jsonl for each job that failed. Files of a shard have its number in their names
/// (results-2-of-8.jsonl). Lines are added when jobs end; `finish` sorts them by job. Adding lines
/// is thread-safe.
class ResultFolder {
 public:
  /// `jobs` are the jobs of the batch or of `shard`, and must outlive the object. Creates the
  /// folder if necessary. With `resume`, collects the results of these jobs from all shards, and
  /// removes the temporary files of killed runs. Without it, throws InputError if there are
  /// results. Throws IoError.
  ResultFolder(std::filesystem::path folder, std::span<const Job> jobs, std::optional<Shard> shard,
               bool resume);

  /// Returns the path of failed.jsonl in `folder`; for a shard, the name is like
  /// failed-2-of-8.jsonl.
  static std::filesystem::path failed_file(const std::filesystem::path& folder,
                                           const std::optional<Shard>& shard);

  /// Throws InputError if the input file `read` would also be an output file in `folder`.
  static void require_no_result(const std::filesystem::path& folder,
                                const std::filesystem::path& read);

  const std::filesystem::path& path() const { return folder_; }
  /// Returns whether job `job`, an index, has a result for the same request whose files all exist.
  bool is_done(std::size_t job) const { return done_[job] != 0; }

  /// Returns the file of each job, or an empty path if it has no result.
  std::vector<std::filesystem::path> files() const;

  /// Adds the line of a job. Throws IoError.
  void add_result(std::size_t job, const std::string& line);
  void add_failure(const std::string& line);

  /// Sorts the lines by job. Call it after the last job. Without a shard, also removes the files of
  /// all shards, because their lines were copied. If it throws IoError, no lines are lost.
  void finish();

 private:
  bool counts(std::string_view line, std::size_t& job) const;
  void take_over(const std::filesystem::path& file);
  void remove_leftovers() const;
  void put_in_order(const std::filesystem::path& file, bool is_result) const;

  std::filesystem::path folder_;
  std::span<const Job> jobs_;
  bool is_whole_;  ///< whether there is no shard
  std::filesystem::path results_path_;
  std::filesystem::path failed_path_;
  std::unordered_map<std::string_view, std::size_t> job_of_;  ///< id -> index of the job
  std::vector<char> done_;
  std::mutex mutex_;
  std::unique_ptr<LineFile> results_;
  std::unique_ptr<LineFile> failed_;  ///< null until a job fails
};

}  // namespace lapwing
