#pragma once

#include <chrono>
#include <thread>

#include "lapwing/deform/drag.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "state/draft.h"
#include "support/bent_tube.h"

namespace lapwing::viewer::test {

using lapwing::test::bumpy_tube;

inline const Part kRoi{Part::Role::roi};
inline const Part kBelt{Part::Role::belt};
inline const Part kHandle{Part::Role::handle, 0};
inline const Part kSecondHandle{Part::Role::handle, 1};

inline std::unique_ptr<Kernels> cpu_kernels() {
  return std::make_unique<CpuKernels>();
}

template <class Happened>
void wait_until(const Happened& happened) {
  while (!happened()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

/// Calls `take` until it returns a value, and returns this value.
template <class Take>
auto awaited(const Take& take) {
  auto taken = take();
  wait_until([&] { return taken || (taken = take()); });
  return *std::move(taken);
}

inline RegionSpec box(double from_z, double to_z) {
  return {Box{{-2.0, -2.0, from_z}, {2.0, 2.0, to_z}}};
}

inline RegionSpec listed(VertexSet vertices) {
  return {ListedVertices{std::move(vertices)}};
}

/// A tube along z from 0 to 3, its head to be moved, its foot outside the ROI.
inline AppState chosen_tube() {
  AppState state = open_state(bumpy_tube());
  state = apply(std::move(state), Choose{kRoi, box(0.3, 4.0)});
  return apply(std::move(state), Choose{kHandle, box(2.8, 4.0)});
}

inline Move bent() {
  SimilarityMove move;
  move.translate = {0.4, 0.1, -0.2};
  move.rotate = {Eigen::Vector3d::UnitY(), 35.0};
  return move;
}

inline Move twisted(double degrees) {
  SimilarityMove move;
  move.rotate = {Eigen::Vector3d::UnitZ(), degrees};
  return move;
}

/// In place of a solver: the handle goes where it should, nothing else moves.
inline std::shared_ptr<const MovedVertices> handles_alone(const AppState& state) {
  Positions positions = state.rest->positions;
  const auto motions = motions_of(state).maps;
  for (std::size_t h = 0; h < motions.size(); ++h) {
    for (const Index v : state.selection.handles[h].vertices) {
      positions[v] = motions[h] * positions[v];
    }
  }
  return std::make_shared<const MovedVertices>(moved_vertices(state.rest->positions, positions));
}

/// Returns the positions of the mesh of `state` in a pose.
inline Positions positions_at(const AppState& state, const DragState& pose) {
  Positions positions = state.rest->positions;
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += pose.displacement[v];
  return positions;
}

/// Returns the state after the upper end of the tube was bent and the surface settled.
inline AppState settled_tube() {
  const AppState state = apply(chosen_tube(), MoveHandle{0, bent()});
  return apply(state, Settle{handles_alone(state)});
}

/// Returns whether the states have equal values, even if they share no memory.
inline bool same(const AppState& a, const AppState& b) {
  const auto same_step = [](const auto& p, const auto& q) { return *p == *q; };
  const bool same_result =
      a.settled && b.settled ? *a.settled == *b.settled : !a.settled && !b.settled;
  return a.rest->positions == b.rest->positions && a.selection == b.selection &&
         a.parameters == b.parameters && a.moves == b.moves && same_result &&
         std::equal(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end(), same_step);
}

}  // namespace lapwing::viewer::test
