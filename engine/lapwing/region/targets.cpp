#include "lapwing/region/targets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/falloff.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// A point with a barycentric coordinate this close to 1 is replaced by the corner.
constexpr double kCornerShare = 1e-9;

class Binding {
 public:
  Binding(const TargetSpec& spec, const VertexSet& roi, const VertexSet& held, const Mesh& mesh)
      : spec_(spec),
        mesh_(mesh),
        in_roi_(vertex_mask(mesh.vertex_count(), roi)),
        is_held_(vertex_mask(mesh.vertex_count(), held)) {}

  std::vector<Target> bind() {
    for (std::size_t r = 0; r < spec_.rows.size(); ++r) {
      const TargetRow& row = spec_.rows[r];
      if (!row.position.allFinite()) fail(r, "its position is not finite");
      if (!is_weight(row.weight)) {
        std::ostringstream text;
        text << "expected " << kWeightWords << ", got " << row.weight;
        fail(r, text.str());
      }
      const auto* vertex = std::get_if<Index>(&row.point);
      Target target =
          vertex != nullptr ? at_vertex(r, *vertex) : at_point(r, std::get<Vector3d>(row.point));
      target.position = row.position;
      target.weight = row.weight;
      if (!target.is_vertex() || is_first(r, target)) targets_.push_back(target);
    }
    return std::move(targets_);
  }

 private:
  [[noreturn]] void fail(std::size_t row, const std::string& what,
                         std::vector<Index> vertices = {}) const {
    throw InputError(spec_.where + ": " + name_of(row) + ": " + what, std::move(vertices));
  }

  std::string name_of(std::size_t row) const {
    const auto image_of = spec_.rows[row].image_of;
    return image_of ? "row " + std::to_string(*image_of) + " (its mirror image)"
                    : "row " + std::to_string(row);
  }

  Target at_vertex(std::size_t row, Index v) const {
    if (v >= mesh_.vertex_count()) {
      fail(row,
           "the mesh has no vertex " + std::to_string(v) + ", only 0 to " +
               std::to_string(mesh_.vertex_count() - 1),
           {v});
    }
    if (!in_roi_[v]) {
      fail(
          row,
          "vertex " + std::to_string(v) + " is outside the ROI. Enlarge the ROI, or remove the row",
          {v});
    }
    if (is_held_[v]) {
      fail(row,
           "vertex " + std::to_string(v) +
               " also belongs to the belt or a handle. Remove it there, or remove the row",
           {v});
    }
    return {{v, v, v}, {1.0, 0.0, 0.0}};
  }

  Target at_point(std::size_t row, const Vector3d& point) {
    if (!point.allFinite()) fail(row, "its point is not finite");
    if (!surface_) make_surface(row);
    const TrianglePoint nearest = surface_->find(0, point, Vector3d::Zero(), hint_);
    hint_ = nearest.hint;
    const Triangle& corners = mesh_.topology().triangles[nearest.triangle];
    for (std::size_t k = 0; k < 3; ++k) {
      if (nearest.weights[k] >= 1.0 - kCornerShare) return at_vertex(row, corners[k]);
    }
    return {corners, nearest.weights};
  }

  void make_surface(std::size_t row) {
    const std::vector<Triangle>& triangles = mesh_.topology().triangles;
    Adjacency group;
    CancelCheck cancel_check;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      cancel_check();
      const bool inside = std::all_of(triangles[t].begin(), triangles[t].end(),
                                      [&](Index v) { return in_roi_[v] != 0; });
      if (inside) group.values.push_back(static_cast<Index>(t));
    }
    if (group.values.empty()) {
      fail(row, "the ROI has no triangle to find the nearest point on. Name a vertex instead");
    }
    group.starts.push_back(static_cast<Index>(group.values.size()));
    surface_.emplace(triangles, mesh_.positions, group);
  }

  bool is_first(std::size_t row, const Target& target) {
    const auto [found, is_new] = first_rows_.emplace(target.corners[0], row);
    if (is_new) return true;
    if (spec_.rows[found->second].position != target.position) {
      fail(row,
           "vertex " + std::to_string(target.corners[0]) + " has another position in " +
               name_of(found->second) + ". Remove one of the two rows",
           {target.corners[0]});
    }
    return false;
  }

  const TargetSpec& spec_;
  const Mesh& mesh_;
  std::vector<char> in_roi_;
  std::vector<char> is_held_;
  std::optional<ClosestPoint> surface_;
  Index hint_ = kNoIndex;
  std::map<Index, std::size_t> first_rows_;  // vertex -> row
  std::vector<Target> targets_;
};

}  // namespace

Vector3d point_of(const Target& target, std::span<const Vector3d> positions) {
  if (target.is_vertex()) return positions[target.corners[0]];
  Vector3d point = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) point += target.shares[k] * positions[target.corners[k]];
  return point;
}

VertexSet corners_of(std::span<const Target> targets) {
  std::vector<Index> corners;
  for (const Target& target : targets) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (target.shares[k] > 0.0) corners.push_back(target.corners[k]);
    }
  }
  return make_vertex_set(std::move(corners));
}

TargetRow target_row(std::span<const double> numbers, const std::string& where) {
  const std::size_t count = numbers.size();
  if (count < 4 || count > 7) {
    throw InputError(where +
                     ": expected 4 numbers (vertex, x, y, z) or 6 (a point on the surface, "
                     "then its target), and optionally a weight, got " +
                     std::to_string(count));
  }
  TargetRow row;
  const std::size_t first = count < 6 ? 1 : 3;
  if (first == 1) {
    const double v = numbers[0];
    if (!(v >= 0.0) || v != std::floor(v) || v >= static_cast<double>(kNoIndex)) {
      throw InputError(where + ": expected the number of a vertex, from 0, got " +
                       std::to_string(v));
    }
    row.point = static_cast<Index>(v);
  } else {
    row.point = Vector3d(numbers[0], numbers[1], numbers[2]);
  }
  row.position = {numbers[first], numbers[first + 1], numbers[first + 2]};
  if (count == first + 4) row.weight = numbers.back();
  return row;
}

std::vector<Target> resolve_targets(const TargetSpec& spec, const VertexSet& roi,
                                    const VertexSet& held, const Mesh& mesh) {
  if (spec.rows.empty()) return {};
  return Binding(spec, roi, held, mesh).bind();
}

}  // namespace lapwing
