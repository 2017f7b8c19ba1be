#include "lapwing/batch/result_folder.h"

#include <algorithm>
#include <regex>

#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/io/atomic_file.h"
#include "lapwing/io/paths.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Returns ".jsonl", or "-2-of-8.jsonl" for a shard.
std::string ending_of(const std::optional<Shard>& shard) {
  if (!shard) return ".jsonl";
  return "-" + std::to_string(shard->number) + "-of-" + std::to_string(shard->count) + ".jsonl";
}

std::vector<fs::path> files_like(const fs::path& folder, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (std::regex_match(entry.path().filename().string(), regex)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

constexpr const char* kAnyResults = R"(results(-\d+-of-\d+)?\.jsonl)";
constexpr const char* kShardFiles = R"((results|failed)-\d+-of-\d+\.jsonl)";
constexpr const char* kAnyLines = R"((results|failed)(-\d+-of-\d+)?\.jsonl)";
constexpr const char* kTemporary = R"((.*)\.tmp-\d+)";

}  // namespace

fs::path ResultFolder::failed_file(const fs::path& folder, const std::optional<Shard>& shard) {
  return folder / ("failed" + ending_of(shard));
}

void ResultFolder::require_no_result(const fs::path& folder, const fs::path& read) {
  const fs::path file = real_path(read);
  const bool is_called_so = std::regex_match(file.filename().string(), std::regex(kAnyLines));
  if (!is_called_so || file.parent_path() != real_path(folder / file.filename()).parent_path()) {
    return;
  }
  throw InputError(read.string() +
                   " has the name of a file that the batch writes; rename it, or choose another "
                   "folder");
}

ResultFolder::ResultFolder(fs::path folder, std::span<const Job> jobs, std::optional<Shard> shard,
                           bool resume)
    : folder_(std::move(folder)),
      jobs_(jobs),
      is_whole_(!shard),
      results_path_(folder_ / ("results" + ending_of(shard))),
      failed_path_(failed_file(folder_, shard)),
      done_(jobs.size(), 0) {
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (jobs[k].error.empty()) job_of_.emplace(jobs[k].id, k);
  }
  try {
    fs::create_directories(folder_);
  } catch (const fs::filesystem_error& error) {
    throw IoError("cannot create the folder " + folder_.string() + ": " + error.code().message() +
                  "; choose another");
  }
  const std::vector<fs::path> others = files_like(folder_, kAnyResults);
  for (const fs::path& other : others) {
    const bool is_mine = is_whole_ || other == results_path_ || other == folder_ / "results.jsonl";
    if (resume || !is_mine) continue;
    throw InputError(folder_.string() + " already has results (" + other.filename().string() +
                     "); continue with --resume, or choose another folder");
  }
  results_ = std::make_unique<LineFile>(results_path_);
  fs::remove(failed_path_);
  if (!resume) return;
  remove_leftovers();
  take_over(results_path_);
  for (const fs::path& other : others) take_over(other);
}

// Returns whether `line` is a valid result of one of the jobs, and sets `job` to the index of this
// job.
bool ResultFolder::counts(std::string_view line, std::size_t& job) const {
  const Json result = Json::parse(line, nullptr, false);
  if (!result.is_object()) return false;
  const auto text = [&](const char* key) {
    const auto at = result.find(key);
    return at != result.end() && at->is_string() ? at->get<std::string>() : std::string();
  };
  const std::string id = text("id");
  const auto at = job_of_.find(id);
  if (at == job_of_.end() || text("job") != text_of(jobs_[at->second].asked)) return false;
  job = at->second;
  std::vector<std::string> files{text("file")};
  if (const std::string rest = text("rest"); !rest.empty()) files.push_back(rest);
  if (const auto carried = result.find("carried"); carried != result.end()) {
    for (const Json& file : *carried)
      files.push_back(file.is_string() ? file.get<std::string>() : "");
  }
  return std::all_of(files.begin(), files.end(), [&](const std::string& file) {
    return !file.empty() && fs::is_regular_file(folder_ / file);
  });
}

void ResultFolder::take_over(const fs::path& file) {
  for_each_line(file, [&](std::string_view line) {
    std::size_t job = 0;
    if (!counts(line, job) || is_done(job)) return;
    if (file != results_path_) results_->append(std::string(line));
    done_[job] = 1;
  });
}

// Removes only files of jobs in `jobs_`, because other processes may write to the folder.
void ResultFolder::remove_leftovers() const {
  const std::regex temporary(kTemporary);
  for (const fs::path& leftover : files_like(folder_, kTemporary)) {
    const std::string name = leftover.filename().string();
    std::smatch parts;
    std::regex_match(name, parts, temporary);
    const std::string target = parts[1];
    bool is_here = target == results_path_.filename() || target == failed_path_.filename();
    for (std::size_t end = 0; end < target.size() && !is_here; ++end) {
      const bool may_end_id = target[end] == '.' || target[end] == '-';
      is_here = may_end_id && job_of_.contains(std::string_view(target).substr(0, end));
    }
    if (is_here) fs::remove(leftover);
  }
}

void ResultFolder::add_result(std::size_t job, const std::string& line) {
  const std::lock_guard lock(mutex_);
  results_->append(line);
  done_[job] = 1;
}

void ResultFolder::add_failure(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (failed_ == nullptr) failed_ = std::make_unique<LineFile>(failed_path_);
  failed_->append(line);
}

// If a job has several lines, only the last one is kept.
void ResultFolder::put_in_order(const fs::path& file, bool is_result) const {
  std::vector<std::string> lines(jobs_.size());
  std::unordered_map<std::size_t, std::size_t> job_at;
  for (std::size_t k = 0; k < jobs_.size(); ++k) job_at.emplace(jobs_[k].line, k);
  for_each_line(file, [&](std::string_view line) {
    std::size_t job = 0;
    if (is_result) {
      if (counts(line, job)) lines[job] = line;
    } else {
      lines[job_at.at(Json::parse(line).at("line").get<std::size_t>())] = line;
    }
  });
  FileReplacement ordered(file);
  for (const std::string& line : lines) {
    if (!line.empty()) ordered.write(line + "\n");
  }
  ordered.commit();
}

std::vector<fs::path> ResultFolder::files() const {
  std::vector<fs::path> files(jobs_.size());
  for_each_line(results_path_, [&](std::string_view line) {
    std::size_t job = 0;
    if (counts(line, job)) files[job] = folder_ / Json::parse(line).at("file").get<std::string>();
  });
  return files;
}

void ResultFolder::finish() {
  put_in_order(results_path_, true);
  if (failed_ != nullptr) put_in_order(failed_path_, false);
  if (!is_whole_) return;
  for (const fs::path& file : files_like(folder_, kShardFiles)) fs::remove(file);
}

}  // namespace lapwing
