#pragma once

#include <vector>

#include "report/compare.h"

namespace lapwing::bench {

/// A row that both reports have.
struct RowPair {
  RowKey key;
  const Measurement* before;
  const Measurement* after;
};

/// Adds to `comparison` what compare() says about times.
void compare_times(const Report& before, const Report& after, const std::vector<RowPair>& rows,
                   Comparison& comparison);

}  // namespace lapwing::bench
