#include "lapwing/deform/prepared_deform.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/base/worker_pool.h"

namespace lapwing {
namespace {

// Rethrows the error at hand as one of its kind that says which motion it came of.
[[noreturn]] void rethrow_of_motion(std::size_t k) {
  const std::string place = "motion " + std::to_string(k) + ": ";
  try {
    throw;
  } catch (const InputError& error) {
    throw InputError(place + error.what(), error.vertices());
  } catch (const SolverError& error) {
    throw SolverError(place + error.what(), error.vertices());
  }
}

// What the threads of one `solve_many` have in common.
struct SharedCount {
  std::size_t count;
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> stopped = false;
  std::mutex mutex;
  std::exception_ptr first_error;

  void fail(std::exception_ptr error) {
    const std::lock_guard lock(mutex);
    if (!first_error) first_error = std::move(error);
    stopped = true;
  }

  double fraction() const { return static_cast<double>(done) / static_cast<double>(count); }
};

}  // namespace

PreparedDeform::PreparedDeform(Mesh mesh, DeformRequest request, const Progress& progress)
    : mesh_(std::move(mesh)), request_(std::move(request)) {
  for (MovedHandle& handle : request_.handles) handle.move = SimilarityMove();
  region_ = deform(mesh_, request_, kernels_, workspace_, progress).region;
}

Deformed PreparedDeform::solve(std::span<const Move> moves, const Progress& progress) {
  if (moves.size() != request_.handles.size()) {
    throw InputError("the edit has " + std::to_string(request_.handles.size()) + " handles, but " +
                     std::to_string(moves.size()) + " moves were given; give one per handle");
  }
  DeformRequest moved = request_;
  for (std::size_t h = 0; h < moves.size(); ++h) moved.handles[h].move = moves[h];
  return deform(mesh_, moved, kernels_, workspace_, progress);
}

void PreparedDeform::solve_many(std::size_t count, const MovesOf& moves_of, const Take& take,
                                unsigned threads, const Progress& progress) {
  if (count == 0) return;
  SharedCount shared{count};
  const auto work = [&](PreparedDeform& edit, const Progress& heard) {
    while (!shared.stopped) {
      const std::size_t k = shared.next++;
      if (k >= count) return;
      try {
        take(k, edit.solve(moves_of(k), heard));
        ++shared.done;
      } catch (const Cancelled&) {
        shared.fail(std::current_exception());
      } catch (...) {
        try {
          rethrow_of_motion(k);
        } catch (...) {
          shared.fail(std::current_exception());
        }
      }
    }
  };
  const Progress heard_aside = [&](std::string_view, double) { return !shared.stopped; };
  const Progress heard_here = [&](std::string_view, double) {
    return !shared.stopped && (!progress || progress("solve_many", shared.fraction()));
  };

  const std::size_t wanted = threads > 0 ? threads : thread_count();
  std::vector<std::jthread> others;
  for (std::size_t t = 1; t < std::min(wanted, count); ++t) {
    others.emplace_back([&] {
      const WorkAlone alone;
      try {
        PreparedDeform own(mesh_, request_, heard_aside);
        work(own, heard_aside);
      } catch (...) {
        shared.fail(std::current_exception());
      }
    });
  }
  {
    std::optional<WorkAlone> alone;
    if (!others.empty()) alone.emplace();
    work(*this, heard_here);
  }
  others.clear();
  if (shared.first_error) std::rethrow_exception(shared.first_error);
  report_progress(progress, "solve_many", 1.0);
}

}  // namespace lapwing
