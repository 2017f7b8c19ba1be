#include "lapwing/elastic/history_loops.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace lapwing {
namespace {

double history_number(std::size_t k) {
  return std::sin(1.0 + 3.7 * static_cast<double>(k));
}

// Counts that are no whole number of registers among them.
TEST(HistoryLoops, EveryInstructionSetComesToTheSumsAsTheyRead) {
  for (const std::size_t count : {0, 1, 7, 16, 37, 1024}) {
    std::vector<float> a;
    std::vector<float> b;
    std::vector<double> x;
    double a_x = 0.0;
    double a_b = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      a.push_back(static_cast<float>(history_number(k)));
      b.push_back(static_cast<float>(history_number(k + 2000)));
      x.push_back(history_number(k + 4000));
      a_x += static_cast<double>(a[k]) * x[k];
      a_b += static_cast<double>(a[k]) * static_cast<double>(b[k]);
    }
    for (const InstructionSet set : available_instruction_sets()) {
      SCOPED_TRACE(std::string(instruction_set_name(set)) + ", " + std::to_string(count));
      const HistoryLoops& loops = history_loops(set);
      EXPECT_NEAR(loops.multiply(a.data(), x.data(), count), a_x, 1e-12);
      EXPECT_NEAR(loops.dot(a.data(), b.data(), count), a_b, 1e-12);
      std::vector<double> y = x;
      loops.subtract(0.3, a.data(), y.data(), count);
      for (std::size_t k = 0; k < count; ++k) {
        EXPECT_NEAR(y[k], x[k] - 0.3 * static_cast<double>(a[k]), 1e-15) << k;
      }
    }
  }
}

}  // namespace
}  // namespace lapwing
