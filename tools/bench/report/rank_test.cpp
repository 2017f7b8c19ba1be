// Based on: Mann and Whitney, "On a test of whether one of two random variables is stochastically
// larger than the other", 1947; Benjamini and Hochberg, "Controlling the false discovery rate",
// 1995.
#include "report/rank_test.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace lapwing::bench {
namespace {

constexpr std::size_t kExactUpTo = 20;  // runs on either side: C(40, 20) sets are exact in a double

// Of two sets of runs put together: every run's rank, doubled so that midranks are whole too.
struct Ranks {
  std::vector<std::size_t> doubled;  // the first set's come first
  double ties = 0.0;                 // sum of t^3 - t over groups of t equal numbers
};

Ranks ranks_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> values = a;
  values.insert(values.end(), b.begin(), b.end());
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  Ranks ranks;
  ranks.doubled.resize(values.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (std::size_t k = first; k < end; ++k) ranks.doubled[order[k]] = first + 1 + end;
    const auto equal = static_cast<double>(end - first);
    ranks.ties += equal * equal * equal - equal;
  }
  return ranks;
}

// Over every way to choose `a` of the ranks: the share of those whose sum is as far from its mean.
double exact(const Ranks& ranks, std::size_t a, std::size_t sum) {
  const std::size_t total =
      std::accumulate(ranks.doubled.begin(), ranks.doubled.end(), std::size_t{0});
  // ways[k][s]: in how many ways k of the ranks so far add up to s.
  std::vector<std::vector<double>> ways(a + 1, std::vector<double>(total + 1, 0.0));
  ways[0][0] = 1.0;
  for (const std::size_t rank : ranks.doubled) {
    for (std::size_t k = a; k > 0; --k) {
      for (std::size_t s = rank; s <= total; ++s) ways[k][s] += ways[k - 1][s - rank];
    }
  }
  const std::size_t n = ranks.doubled.size();
  const auto off = [&](std::size_t s) {
    return s * n > total * a ? s * n - total * a : total * a - s * n;
  };
  double as_far = 0.0;
  for (std::size_t s = 0; s <= total; ++s) {
    if (off(s) >= off(sum)) as_far += ways[a][s];
  }
  return as_far / std::accumulate(ways[a].begin(), ways[a].end(), 0.0);
}

double approximate(const Ranks& ranks, std::size_t size, std::size_t sum) {
  const auto a = static_cast<double>(size);
  const auto n = static_cast<double>(ranks.doubled.size());
  const double b = n - a;
  const double variance = a * b / 12.0 * (n + 1.0 - ranks.ties / (n * (n - 1.0)));
  if (!(variance > 0.0)) return 1.0;  // all numbers are equal
  const double off = std::abs(static_cast<double>(sum) / 2.0 - a * (n + 1.0) / 2.0);
  const double z = std::max(off - 0.5, 0.0) / std::sqrt(variance);
  return std::erfc(z / std::sqrt(2.0));
}

}  // namespace

double rank_test(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || b.empty()) return 1.0;
  const Ranks ranks = ranks_of(a, b);
  const auto first_of_b = ranks.doubled.begin() + static_cast<std::ptrdiff_t>(a.size());
  const std::size_t sum = std::accumulate(ranks.doubled.begin(), first_of_b, std::size_t{0});
  const bool small = a.size() <= kExactUpTo && b.size() <= kExactUpTo;
  return small ? exact(ranks, a.size(), sum) : approximate(ranks, a.size(), sum);
}

double smallest_rank_test(std::size_t a, std::size_t b) {
  std::vector<double> low(a);
  std::vector<double> high(b);
  std::iota(low.begin(), low.end(), 0.0);
  std::iota(high.begin(), high.end(), static_cast<double>(a));
  return rank_test(low, high);
}

double discovery_threshold(std::vector<double> probabilities, double false_share) {
  std::sort(probabilities.begin(), probabilities.end());
  const auto count = static_cast<double>(probabilities.size());
  for (std::size_t k = probabilities.size(); k > 0; --k) {
    const double bound = false_share * static_cast<double>(k) / count;
    if (probabilities[k - 1] <= bound) return probabilities[k - 1];
  }
  return -1.0;
}

}  // namespace lapwing::bench
