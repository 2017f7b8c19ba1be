#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/solve/dissection/cut_score.h"

namespace lapwing::dissection {

/// A priority queue of nodes by the gain of moving them. Among equal gains, the node with the
/// higher number comes first. If a gain changes, the node is added again. The caller of `take` must
/// therefore compare the returned gain with the node's current gain.
class MoveQueue {
 public:
  struct Move {
    int gain;
    int node;
  };

  void reserve(std::size_t count) { heap_.reserve(count); }
  void clear() { heap_.clear(); }
  bool empty() const { return heap_.empty(); }
  void add(int gain, int node) {
    heap_.push_back((std::int64_t{gain} << kNodeBits) + node);
    std::push_heap(heap_.begin(), heap_.end());
  }
  Move take() {
    std::pop_heap(heap_.begin(), heap_.end());
    const std::int64_t key = heap_.back();
    heap_.pop_back();
    return {static_cast<int>(key >> kNodeBits), static_cast<int>(key & kNodeMask)};
  }

 private:
  static constexpr int kNodeBits = 32;
  static constexpr std::int64_t kNodeMask = (std::int64_t{1} << kNodeBits) - 1;

  std::vector<std::int64_t> heap_;  // gain and node in one number
};

/// Improves a cut by the moves of Fiduccia and Mattheyses (1982). A pass repeatedly moves the node
/// with the largest gain to the other side, even at a loss, but each node only once. Then the moves
/// after the best state of the pass are undone. `Cut` has
///
///     int size(), weight(v), border(v), side(v)
///     int separator()                             the separator's weight, or a monotonic function
///     bool on_border(v)                           only nodes on the border are moved
///     int gain(v)                                 decrease of the separator's weight if v moves
///     void move(v)
///     void for_affected(v, f)                     f(u) for all nodes u that a move of v affects
template <typename Cut>
class Improvement {
 public:
  /// A pass ends after `patience` moves without an improvement.
  Improvement(Cut& cut, int patience) : cut_(cut), patience_(patience) {
    for (int v = 0; v < cut.size(); ++v) {
      sides_.add(cut.weight(v), cut.border(v), cut.side(v));
    }
    gains_.resize(static_cast<std::size_t>(cut.size()));
    queue_.reserve(gains_.size());
    locked_.resize(static_cast<std::size_t>(cut.size()));
  }

  void run(int most_passes) {
    for (int pass = 0; pass < most_passes && improve(); ++pass) {
    }
  }

  CutScore score() const { return {sides_, cut_.separator()}; }

 private:
  bool improve() {
    std::fill(locked_.begin(), locked_.end(), 0);
    std::fill(gains_.begin(), gains_.end(), std::numeric_limits<int>::min());
    queue_.clear();
    moved_.clear();
    for (int v = 0; v < cut_.size(); ++v) add(v);
    const CutScore before = score();
    CutScore best = before;
    std::size_t kept = 0;
    while (!queue_.empty() && moved_.size() < kept + static_cast<std::size_t>(patience_)) {
      check_();
      const MoveQueue::Move next = queue_.take();
      const int v = next.node;
      if (locked_[v] || gains_[v] != next.gain || !cut_.on_border(v)) continue;
      if (!sides_.allows(cut_.weight(v), cut_.side(v))) continue;
      move(v);
      locked_[v] = 1;
      moved_.push_back(v);
      cut_.for_affected(v, [&](int u) { add(u); });
      if (const CutScore now = score(); now < best) {
        best = now;
        kept = moved_.size();
      }
    }
    for (; moved_.size() > kept; moved_.pop_back()) move(moved_.back());
    return best < before;
  }

  void add(int v) {
    if (locked_[v] || !cut_.on_border(v)) return;
    const int gain = cut_.gain(v);
    if (std::exchange(gains_[v], gain) != gain) queue_.add(gain, v);
  }

  void move(int v) {
    sides_.move(cut_.weight(v), cut_.border(v), cut_.side(v));
    cut_.move(v);
  }

  Cut& cut_;
  SideWeights sides_;
  int patience_;
  std::vector<int> gains_;  // gain of each node when it was last added to the queue
  std::vector<char> locked_;
  std::vector<int> moved_;
  MoveQueue queue_;
  CancelCheck check_;
};

}  // namespace lapwing::dissection
