#pragma once

#include <array>
#include <optional>

#include "state/app_state.h"

namespace lapwing::viewer {

/// The difference of two states, to undo and redo one step. It stores set differences and the
/// positions of moved vertices, or both meshes if the connectivity changes.
class Change {
 public:
  Change() = default;
  Change(const AppState& before, const AppState& after);

  bool is_nothing() const;
  /// Returns whether the surface or the move of a handle changes.
  bool concerns_surface() const;

  /// `redo` changes the state before the step to the state after it; `undo` does the reverse.
  void redo(AppState& state) const { replace(state, 0, 1); }
  void undo(AppState& state) const { replace(state, 1, 0); }

 private:
  // The values before and after; not set if they are equal.
  template <class T>
  using Both = std::optional<std::array<T, 2>>;

  // The vertices that are only in the first set, and those that are only in the second set.
  using SetChange = std::array<VertexSet, 2>;

  struct RegionChange {
    Both<RegionSpec> made;
    SetChange added;
    SetChange removed;
    SetChange vertices;
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
  Both<std::vector<Index>> held_holes_;
  std::array<std::size_t, 2> handle_counts_{};
  std::vector<RegionChange> handles_;    // a handle that one state lacks counts as empty there
  Both<std::vector<Falloff>> falloffs_;  // one per handle
  Both<std::optional<MirrorPlane>> mirror_;
  Both<std::shared_ptr<const MirroredEdit>> mirrored_;
  Both<std::vector<StiffnessSpec>> stiffness_;
  Both<std::optional<double>> belt_fraction_;
  Both<EditParameters> parameters_;
  Both<std::vector<HandleMove>> moves_;
  Both<Settled> settled_;
  Both<std::vector<CarriedObject>> carried_;
  Both<MovedVertices> rest_;                     // only the vertices whose positions differ
  Both<std::shared_ptr<const Mesh>> triangles_;  // instead of `rest_`
  bool surface_moved_ = false;                   // whether a new rest shape changes the surface
  std::size_t kept_steps_ = 0;                   // number of steps that both states share
  std::array<Steps, 2> steps_;                   // the other steps
};

}  // namespace lapwing::viewer
