#include "lapwing/io/welder.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

std::uint64_t position_hash(const Eigen::Vector3d& position) {
  std::uint64_t state = 0;
  for (const double x : position) {
    state = (state ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9E3779B97F4A7C15U;  // -0 + 0 is 0
    state ^= state >> 32U;
  }
  return state;
}

}  // namespace

Index Welder::vertex_at(const Eigen::Vector3d& position) {
  if (2 * (positions_.size() - first_ + 1) > slots_.size())
    resize_table(std::max<std::size_t>(64, 2 * slots_.size()));
  const auto vertex = static_cast<Index>(positions_.size());
  // Positions with a NaN equal none, so they would pile up in one place of the table.
  if (!position.hasNaN()) {
    const std::size_t slot = find_slot(position);
    if (slots_[slot] != kNoIndex) return slots_[slot];
    slots_[slot] = vertex;
  }
  positions_.push_back(position);
  return vertex;
}

std::size_t Welder::find_slot(const Eigen::Vector3d& position) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = position_hash(position) & mask;
  while (slots_[slot] != kNoIndex && positions_[slots_[slot]] != position) slot = (slot + 1) & mask;
  return slot;
}

void Welder::reserve(std::size_t count) {
  positions_.reserve(first_ + count);
  resize_table(std::bit_ceil(2 * (count + 1)));
}

void Welder::resize_table(std::size_t size) {
  slots_.assign(size, kNoIndex);
  CancelCheck cancel_check;
  for (std::size_t v = first_; v < positions_.size(); ++v) {
    cancel_check();
    if (!positions_[v].hasNaN()) slots_[find_slot(positions_[v])] = static_cast<Index>(v);
  }
}

}  // namespace lapwing
