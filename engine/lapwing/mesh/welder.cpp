#include "lapwing/mesh/welder.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

// The finalizer of MurmurHash3. Coordinates of real meshes differ only in a few middle bits, which
// this spreads over the whole word.
std::uint64_t mix(std::uint64_t bits) {
  bits ^= bits >> 33;
  bits *= 0xFF51AFD7ED558CCDULL;
  bits ^= bits >> 33;
  bits *= 0xC4CEB9FE1A85EC53ULL;
  return bits ^ (bits >> 33);
}

std::uint64_t position_hash(const Eigen::Vector3d& position) {
  std::uint64_t hash = 0;
  // Adding 0 turns -0 into 0.
  for (const double x : position) hash = mix(hash + std::bit_cast<std::uint64_t>(x + 0.0));
  return hash;
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

std::vector<Index> first_at_same_position(std::span<const Eigen::Vector3d> positions) {
  Positions distinct;
  Welder welder(distinct);
  welder.reserve(positions.size());
  std::vector<Index> first_of_distinct;
  std::vector<Index> first(positions.size());
  CancelCheck cancel_check;
  for (Index v = 0; v < positions.size(); ++v) {
    cancel_check();
    first[v] = v;
    if (!positions[v].allFinite()) continue;
    const Index number = welder.vertex_at(positions[v]);
    if (number == first_of_distinct.size()) first_of_distinct.push_back(v);
    first[v] = first_of_distinct[number];
  }
  return first;
}

}  // namespace lapwing
