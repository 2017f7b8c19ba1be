#include "lapwing/solve/detached.h"

#include <future>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;

const Progress kYes = [](std::string_view, double) { return true; };

TEST(Abandonable, ReturnsAndThrowsWhatTheWorkDoes) {
  const auto count = [] { return std::vector<int>{1, 2, 3}; };
  const auto fail = []() -> std::vector<int> { throw std::runtime_error("from the library"); };
  EXPECT_THAT(run_detached(count), ElementsAre(1, 2, 3));
  EXPECT_THROW(run_detached(fail), std::runtime_error);
  const ProgressScope scope(kYes);
  EXPECT_THAT(run_detached(count), ElementsAre(1, 2, 3));
  EXPECT_THROW(run_detached(fail), std::runtime_error);
}

// The work ends only after it was given up.
TEST(Abandonable, IsCancelledWhileTheWorkGoesOn) {
  const auto release = std::make_shared<std::promise<void>>();
  const auto ended = std::make_shared<std::promise<void>>();
  int asked = 0;
  {
    const ProgressScope scope([&](std::string_view, double) { return ++asked < 3; });
    EXPECT_THROW(run_detached([release, ended] {
                   release->get_future().wait();
                   ended->set_value();
                   return std::vector<int>{};
                 }),
                 Cancelled);
  }
  release->set_value();
  ended->get_future().wait();
  const ProgressScope scope(kYes);
  EXPECT_THAT(run_detached([] { return std::vector<int>{7}; }), ElementsAre(7));
}

}  // namespace
}  // namespace lapwing
