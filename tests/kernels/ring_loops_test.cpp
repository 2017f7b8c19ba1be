#include "lapwing/kernels/ring_loops.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "kernels/turned_rings.h"
#include "lapwing/kernels/cpu_ring_rotations.h"

namespace lapwing {
namespace {

using test::Sample;
using test::TurnedRings;

void expect_near(const std::vector<double>& actual, const std::vector<double>& expected) {
  double largest = 0.0;
  for (const double x : expected) largest = std::max(largest, std::abs(x));
  for (std::size_t k = 0; k < expected.size(); ++k) {
    ASSERT_NEAR(actual[k], expected[k], 1e-12 * largest) << k;
  }
}

// All other tests of the kernels use only the fastest instruction set.
TEST(RingLoops, EveryInstructionSetLeavesTheEnergyAndGradientOfTheFastest) {
  const Sample sample("rough sphere", test::rough_sphere(3, 0.2, 31));
  const TurnedRings turned = test::turned_rings(sample, 70, 0.4, 0.5, 32);
  const auto fit_by = [&](InstructionSet set) {
    CpuRingRotations rotations(std::make_shared<RegionRings>(turned.rings), set);
    return test::fit(rotations, turned);
  };
  const test::Fitted fastest = fit_by(available_instruction_sets().front());
  for (const InstructionSet set : available_instruction_sets()) {
    SCOPED_TRACE(instruction_set_name(set));
    const test::Fitted results = fit_by(set);
    expect_near(results.energies, fastest.energies);
    expect_near(results.gradient, fastest.gradient);
  }
}

}  // namespace
}  // namespace lapwing
