#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

namespace lapwing {

/// Assigns jobs to workers. A worker stays with a group while it has jobs left, and then takes a
/// group that no other worker has, if there is one. Thread-safe.
class JobQueue {
 public:
  static constexpr std::size_t kNoGroup = static_cast<std::size_t>(-1);

  /// `groups` holds the jobs of each group, in order.
  explicit JobQueue(std::vector<std::vector<std::size_t>> groups);

  /// Returns the next job for a worker whose last job was of `group` (kNoGroup at first), and sets
  /// `group` to that of the job. Returns nothing when all jobs are assigned.
  std::optional<std::size_t> next(std::size_t& group);

 private:
  std::size_t left(std::size_t group) const { return groups_[group].size() - given_[group]; }

  std::mutex mutex_;
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<std::size_t> given_;   ///< per group, the number of assigned jobs
  std::size_t first_untouched_ = 0;  ///< first group without assigned jobs
  std::vector<std::size_t> begun_;   ///< started groups that may have jobs left
};

}  // namespace lapwing
