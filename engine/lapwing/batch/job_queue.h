#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

namespace lapwing {

/// Hands jobs to workers so that each goes on with jobs of one group as long as there are any, and
/// with a group of its own as long as there is one. Threads may ask at once.
class JobQueue {
 public:
  static constexpr std::size_t kNoGroup = static_cast<std::size_t>(-1);

  /// Of the jobs of one group, in order.
  explicit JobQueue(std::vector<std::vector<std::size_t>> groups);

  /// The next job for a worker that was last given one of `group` (kNoGroup at first), which
  /// becomes that of the job; nothing when all are given out.
  std::optional<std::size_t> next(std::size_t& group);

 private:
  std::size_t left(std::size_t group) const { return groups_[group].size() - given_[group]; }

  std::mutex mutex_;
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<std::size_t> given_;   ///< per group, how many jobs were handed out
  std::size_t first_untouched_ = 0;  ///< group
  std::vector<std::size_t> begun_;   ///< groups that may have jobs left
};

}  // namespace lapwing
