#pragma once

#include <cstddef>
#include <vector>

namespace lapwing::bench {

/// The two-sided Mann-Whitney U test: how probable it is that two sets of runs of the same thing
/// differ in their ranks by as much as these or by more. Nothing is assumed about how runs scatter.
/// Exact, also where numbers are equal (midranks), up to 20 runs on either side; by the normal
/// approximation with corrections for ties and continuity beyond. 1 where a side is empty.
double rank_test(const std::vector<double>& a, const std::vector<double>& b);

/// The smallest value that the test can give for so many runs on the two sides.
double smallest_rank_test(std::size_t a, std::size_t b);

/// The procedure of Benjamini and Hochberg: the largest of `probabilities` that may still be called
/// a difference when of all those called a share of at most `false_share` shall be chance; below 0
/// where none may.
double discovery_threshold(std::vector<double> probabilities, double false_share);

}  // namespace lapwing::bench
