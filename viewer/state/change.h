#pragma once

#include <array>
#include <optional>

#include "state/app_state.h"

namespace lapwing::viewer {

/// What one step changed of the state, enough to go from either side to the other: differences of
/// sets and positions of the vertices that moved. Only where the triangles are others are both
/// meshes held, with their topologies, for as long as the step is: a few hundred bytes per vertex
/// of each. Steps that follow each other share the mesh between them.
class Change {
 public:
  Change() = default;
  Change(const AppState& before, const AppState& after);

  bool is_nothing() const;
  /// Whether the surface, or where its handles want it, is another one.
  bool concerns_surface() const;

  /// `state` is the one before (after); makes it the one after (before).
  void redo(AppState& state) const { replace(state, 0, 1); }
  void undo(AppState& state) const { replace(state, 1, 0); }

  /// About how much memory it holds.
  std::size_t bytes() const;

 private:
  // A pair holds the values before and after; unset where they are equal.
  template <class T>
  using Both = std::optional<std::array<T, 2>>;

  // Vertices that only the one or only the other set has.
  using SetChange = std::array<VertexSet, 2>;

  struct RegionChange {
    Both<RegionSpec> made;
    SetChange added;
    SetChange removed;
    SetChange vertices;
  };
  struct RestChange {
    std::vector<Index> vertices;
    std::array<Positions, 2> positions;
  };
  using Settled = std::shared_ptr<const MovedVertices>;
  using Steps = std::vector<std::shared_ptr<const Step>>;

  void compare_rest(const AppState& before, const AppState& after);
  static RegionChange difference(const ChosenRegion& before, const ChosenRegion& after);
  static void replace(ChosenRegion& region, const RegionChange& change, std::size_t from,
                      std::size_t to);
  void replace(AppState& state, std::size_t from, std::size_t to) const;

  RegionChange roi_;
  RegionChange belt_;
  std::array<std::size_t, 2> handle_counts_{};
  std::vector<RegionChange> handles_;  // of the longer list; one that is not there counts as empty
  Both<std::vector<Grading>> gradings_;  // of all handles
  Both<std::optional<MirrorPlane>> mirror_;
  Both<std::shared_ptr<const MirroredEdit>> mirrored_;
  Both<std::optional<double>> belt_fraction_;
  Both<EditParameters> parameters_;
  Both<std::vector<HandleMove>> moves_;
  Both<Settled> settled_;
  Both<std::vector<CarriedObject>> carried_;
  std::optional<RestChange> rest_;
  Both<std::shared_ptr<const Mesh>> triangles_;  // instead of `rest_`
  bool surface_moved_ = false;                   // by what changed the rest shape
  std::size_t kept_steps_ = 0;
  std::array<Steps, 2> steps_;  // those that follow the kept ones
};

}  // namespace lapwing::viewer
