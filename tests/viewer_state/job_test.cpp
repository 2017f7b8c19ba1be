#include "work/job.h"

#include <gtest/gtest.h>

#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

TEST(Job, CancellationReleasesTheResult) {
  Job<std::shared_ptr<int>> job(cpu_kernels);
  const auto result = std::make_shared<int>(7);
  job.start(
      [held = std::weak_ptr<int>(result)](const auto&, const Progress&) { return held.lock(); });
  wait_until([&] { return !job.status().busy; });
  EXPECT_EQ(result.use_count(), 2);
  job.cancel();
  EXPECT_EQ(result.use_count(), 1);
  EXPECT_FALSE(job.take());
}

TEST(Job, CancelledTaskReleasesItsData) {
  Job<int> job(cpu_kernels);
  auto data = std::make_shared<int>(7);
  job.start([data](const auto&, const Progress& progress) {
    for (;;) report_progress(progress, "work", 0.0);
    return *data;
  });
  job.cancel();
  wait_until([&] { return data.use_count() == 1; });
  EXPECT_FALSE(job.take());
}

}  // namespace
}  // namespace lapwing::viewer::test
