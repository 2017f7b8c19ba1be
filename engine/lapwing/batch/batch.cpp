#include "lapwing/batch/batch.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/base/worker_pool.h"
#include "lapwing/batch/job_file.h"
#include "lapwing/batch/vertex_array.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/run/session.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

std::span<const Job> part_of(std::span<const Job> jobs, const std::optional<Shard>& shard) {
  if (!shard) return jobs;
  const std::size_t begin = jobs.size() * (shard->number - 1) / shard->count;
  return jobs.subspan(begin, jobs.size() * shard->number / shard->count - begin);
}

// Returns the mesh of the first job that can run, or an empty path.
fs::path first_mesh(const JobFile& file) {
  for (const Job& job : file.jobs()) {
    try {
      if (job.error.empty()) return file.recipe_of(job).mesh_path();
    } catch (const InputError&) {
      // This job fails later, when a worker runs it.
    }
  }
  return {};
}

std::vector<std::vector<std::size_t>> groups_of(std::span<const Job> jobs,
                                                const ResultFolder& results) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (results.is_done(k)) continue;
    groups.resize(std::max(groups.size(), jobs[k].group + 1));
    groups[jobs[k].group].push_back(k);
  }
  return groups;
}

// Assigns jobs to workers. A worker gets jobs of one group until all jobs of the group are
// assigned. It then gets a group without assigned jobs, if there is one. The class is thread-safe.
class JobQueue {
 public:
  static constexpr std::size_t kNoGroup = static_cast<std::size_t>(-1);

  // `groups` lists the indices of each group's jobs, in the order of the job file.
  explicit JobQueue(std::vector<std::vector<std::size_t>> groups)
      : groups_(std::move(groups)), given_(groups_.size(), 0) {}

  // Returns the next job for a worker. `group` is the group of the worker's last job, initially
  // kNoGroup. The call sets `group` to the group of the returned job. Returns nothing if all jobs
  // are assigned.
  std::optional<std::size_t> next(std::size_t& group) {
    const std::lock_guard lock(mutex_);
    if (group == kNoGroup || left(group) == 0) {
      std::erase_if(begun_, [&](std::size_t begun) { return left(begun) == 0; });
      while (first_untouched_ < groups_.size() && left(first_untouched_) == 0) ++first_untouched_;
      if (first_untouched_ < groups_.size()) {
        group = first_untouched_++;
        begun_.push_back(group);
      } else if (begun_.empty()) {
        return std::nullopt;
      } else {
        // A second worker of a group must repeat the preparation, so choose the group with the most
        // unassigned jobs.
        group = *std::max_element(begun_.begin(), begun_.end(),
                                  [&](std::size_t a, std::size_t b) { return left(a) < left(b); });
      }
    }
    return groups_[group][given_[group]++];
  }

 private:
  std::size_t left(std::size_t group) const { return groups_[group].size() - given_[group]; }

  std::mutex mutex_;
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<std::size_t> given_;   //< per group, the number of assigned jobs
  std::size_t first_untouched_ = 0;  //< all groups before this index are started or empty
  std::vector<std::size_t> begun_;   //< started groups that may have unassigned jobs
};

class Batch {
 public:
  Batch(const BatchRequest& request, const BatchMonitor& watch)
      : request_(request),
        watch_(watch),
        file_(request.jobs, request.recipe, request.output.words(), request.sandbox),
        jobs_(part_of(file_.jobs(), request.shard)),
        results_(request.folder, jobs_, request.shard, request.resume),
        writer_(request.folder, request.output, meshes_, first_mesh(file_)),
        queue_(groups_of(jobs_, results_)) {
    count_.jobs = jobs_.size();
    for (std::size_t k = 0; k < jobs_.size(); ++k) count_.before += results_.is_done(k) ? 1 : 0;
    count_.done = count_.before;
  }

  BatchCount run(unsigned threads) {
    if (watch_.count) watch_.count(count_);
    if (threads <= 1) {
      work();
    } else {
      std::vector<std::thread> workers;
      for (unsigned t = 0; t < threads; ++t) {
        workers.emplace_back([this] {
          const SerialScope alone;
          work();
        });
      }
      for (std::thread& worker : workers) worker.join();
    }
    if (failure_) rethrow_with_count();
    if (count_.is_complete()) {
      results_.finish();
      if (!request_.vertices.empty()) write_vertex_array(request_.vertices, results_.files());
    }
    return count_;
  }

 private:
  void work() {
    try {
      CpuKernels kernels;
      Session session(kernels, meshes_);
      std::size_t group = JobQueue::kNoGroup;
      while (goes_on()) {
        const std::optional<std::size_t> job = queue_.next(group);
        if (!job) return;
        carry_out(*job, session);
      }
    } catch (const Cancelled&) {
      // The job in progress is discarded.
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stop_ = true;
    }
  }

  bool goes_on() const { return !stop_ && (!watch_.go_on || watch_.go_on()); }

  void carry_out(std::size_t k, Session& session) {
    const Job& job = jobs_[k];
    std::string line;
    try {
      line = line_of(job, session);
    } catch (const JobFailed& failed) {
      add_failure(job, failed.why);
      return;
    }
    results_.add_result(k, line);
    add(&BatchCount::done);
  }

  // Thrown if the job itself fails; other errors end the batch.
  struct JobFailed {
    std::string why;
  };

  std::string line_of(const Job& job, Session& session) {
    if (!job.error.empty()) throw JobFailed{job.error};
    const std::string where = file_.name() + ":" + std::to_string(job.line) + ": ";
    std::unique_ptr<RunResult> result;
    Recipe recipe;
    try {
      recipe = file_.recipe_of(job);
    } catch (const InputError& error) {
      throw JobFailed{error.what()};
    }
    try {
      result = session.run(recipe, [this](std::string_view, double) { return goes_on(); });
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      throw JobFailed{where + error.what()};
    } catch (const std::bad_alloc&) {
      throw JobFailed{where + "out of memory; choose a smaller region or fewer threads"};
    }
    try {
      return writer_.write(job, recipe, *result);
    } catch (const InputError& error) {
      throw JobFailed{where + error.what()};
    }
  }

  void add_failure(const Job& job, const std::string& why) {
    nlohmann::ordered_json line{{"id", job.id}, {"line", job.line}, {"error", why}};
    results_.add_failure(
        line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    add(&BatchCount::failed);
  }

  void add(std::size_t BatchCount::*number) {
    const std::lock_guard lock(mutex_);
    ++(count_.*number);
    if (watch_.count) watch_.count(count_);
  }

  [[noreturn]] void rethrow_with_count() const {
    try {
      std::rethrow_exception(failure_);
    } catch (const IoError& error) {
      throw IoError(std::string(error.what()) + "; " + std::to_string(count_.done) + " of " +
                    std::to_string(count_.jobs) + " jobs are done; continue with --resume");
    }
  }

  const BatchRequest& request_;
  const BatchMonitor& watch_;
  MeshCache meshes_;
  JobFile file_;
  std::span<const Job> jobs_;
  ResultFolder results_;
  ResultWriter writer_;
  JobQueue queue_;
  std::mutex mutex_;
  BatchCount count_;
  std::exception_ptr failure_;
  std::atomic<bool> stop_ = false;
};

}  // namespace

BatchCount run_batch(const BatchRequest& request, const BatchMonitor& watch) {
  for (const std::filesystem::path& read : {request.jobs, request.recipe}) {
    if (!read.empty()) ResultFolder::require_no_result(request.folder, read);
  }
  if (!request.vertices.empty() && request.vertices.extension() != ".npy") {
    throw InputError(request.vertices.string() + ": expected a .npy file for the vertices");
  }
  return Batch(request, watch).run(request.threads > 0 ? request.threads : thread_count());
}

}  // namespace lapwing
