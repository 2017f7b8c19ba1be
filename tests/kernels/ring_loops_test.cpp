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

struct RingResults {
  std::vector<double> energies;
  std::vector<double> gradient;
};

RingResults results_by(InstructionSet set, const TurnedRings& turned) {
  CpuRingRotations rotations(std::make_shared<RegionRings>(turned.rings), set);
  RingResults results{std::vector<double>(turned.rings.row_count()),
                      std::vector<double>(3 * turned.rings.unknown_rows.size())};
  rotations.fit_rotations(turned.displacement, results.energies);
  rotations.energy_gradient(results.gradient);
  return results;
}

void expect_near(const std::vector<double>& actual, const std::vector<double>& expected) {
  double largest = 0.0;
  for (const double x : expected) largest = std::max(largest, std::abs(x));
  for (std::size_t k = 0; k < expected.size(); ++k) {
    ASSERT_NEAR(actual[k], expected[k], 1e-12 * largest) << k;
  }
}

// The fastest set is what all other tests of the kernels run by.
TEST(RingLoops, EveryInstructionSetLeavesTheEnergyAndGradientOfTheFastest) {
  const Sample sample("rough sphere", test::rough_sphere(3, 0.2, 31));
  const TurnedRings turned = test::turned_rings(sample, 70, 0.4, 0.5, 32);
  const RingResults fastest = results_by(available_instruction_sets().front(), turned);
  for (const InstructionSet set : available_instruction_sets()) {
    SCOPED_TRACE(instruction_set_name(set));
    const RingResults results = results_by(set, turned);
    expect_near(results.energies, fastest.energies);
    expect_near(results.gradient, fastest.gradient);
  }
}

}  // namespace
}  // namespace lapwing
