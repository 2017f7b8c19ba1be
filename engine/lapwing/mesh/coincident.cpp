#include "lapwing/mesh/coincident.h"

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

std::uint64_t hash(const Eigen::Vector3d& p) {
  std::uint64_t h = 0;
  // Adding 0 turns -0 into 0.
  for (int axis = 0; axis < 3; ++axis) h = mix(h + std::bit_cast<std::uint64_t>(p[axis] + 0.0));
  return h;
}

}  // namespace

std::vector<Index> first_at_same_position(std::span<const Eigen::Vector3d> positions) {
  const std::size_t slots = std::bit_ceil(2 * positions.size() + 1);
  std::vector<Index> table(slots, kNoIndex);
  std::vector<Index> first(positions.size());
  CancelCheck cancel_check;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    cancel_check();
    first[v] = static_cast<Index>(v);
    if (!positions[v].allFinite()) continue;
    std::size_t slot = hash(positions[v]) & (slots - 1);
    while (table[slot] != kNoIndex && positions[table[slot]] != positions[v]) {
      slot = (slot + 1) & (slots - 1);
    }
    if (table[slot] == kNoIndex) table[slot] = static_cast<Index>(v);
    first[v] = table[slot];
  }
  return first;
}

}  // namespace lapwing
