#include "lapwing/batch/job_queue.h"

#include <algorithm>
#include <utility>

namespace lapwing {

JobQueue::JobQueue(std::vector<std::vector<std::size_t>> groups)
    : groups_(std::move(groups)), given_(groups_.size(), 0) {}

std::optional<std::size_t> JobQueue::next(std::size_t& group) {
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
      // Another worker of a group has to prepare again, which pays off most in the group with the
      // most jobs left.
      group = *std::max_element(begun_.begin(), begun_.end(),
                                [&](std::size_t a, std::size_t b) { return left(a) < left(b); });
    }
  }
  return groups_[group][given_[group]++];
}

}  // namespace lapwing
