#include "lapwing/io/stored_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

#include <Eigen/Geometry>

#include "lapwing/mesh/seams.h"
#include "lapwing/mesh/split_normals.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr double kSameNormal = 1e-6;  // finer than the digits that files print

Vector3d area_vector(std::span<const Index> face, std::span<const Vector3d> positions) {
  Vector3d sum = Vector3d::Zero();
  const Vector3d& origin = positions[face[0]];
  for (std::size_t i = 2; i < face.size(); ++i) {
    sum += (positions[face[i - 1]] - origin).cross(positions[face[i]] - origin);
  }
  return 0.5 * sum;
}

// Returns zero if the sum has no direction.
Vector3d direction(const Vector3d& sum) {
  const double length = sum.norm();
  return length > 0.0 && std::isfinite(length) ? Vector3d(sum / length) : Vector3d::Zero();
}

// A face corner that uses a normal.
struct Use {
  Index normal;
  Index vertex;
  Index corner;
  Index face;
  bool operator<(const Use& other) const {
    return std::tie(normal, vertex, corner) < std::tie(other.normal, other.vertex, other.corner);
  }
};

class NormalUpdate {
 public:
  NormalUpdate(const Mesh& mesh, std::span<const Vector3d> rest)
      : mesh_(mesh),
        rest_(rest),
        stored_{mesh.attributes().normals, mesh.attributes().corner_normals} {}

  StoredNormals run() {
    find_seams();
    const std::vector<Use> uses = uses_of_changed_normals();
    for (auto begin = uses.begin(); begin != uses.end();) {
      const auto end = std::find_if(begin, uses.end(),
                                    [&](const Use& use) { return use.normal != begin->normal; });
      update_normal({begin, end});
      begin = end;
    }
    return std::move(stored_);
  }

 private:
  // The new normal of those corners of a vertex that share one.
  struct Group {
    std::span<const Use> uses;
    Vector3d normal;
    bool changed;
  };

  Index normal_of(std::size_t corner) const {
    if (mesh_.attributes().has_vertex_normals) return mesh_.face_vertices()[corner];
    return mesh_.attributes().corner_normals.empty() ? kNoIndex
                                                     : mesh_.attributes().corner_normals[corner];
  }

  // Collects the corners on seams, sorted by leader.
  void find_seams() {
    const JoinedSurface joined = joined_surface(mesh_);
    if (joined.empty()) return;
    leaders_ = joined.leaders;
    std::vector<char> on_seam(leaders_.size(), 0);
    for (const Index v : joined.followers) on_seam[v] = on_seam[leaders_[v]] = 1;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      for (Index c = mesh_.face_starts()[f]; c < mesh_.face_starts()[f + 1]; ++c) {
        const Index v = mesh_.face_vertices()[c];
        if (!on_seam[v] || normal_of(c) == kNoIndex) continue;
        seam_uses_.push_back({normal_of(c), v, c, static_cast<Index>(f)});
      }
    }
    std::ranges::stable_sort(seam_uses_, {}, [&](const Use& use) { return leaders_[use.vertex]; });
  }

  // Returns the uses at vertices joined to `vertex` that have an equal normal. The surface is
  // smooth there and was split for another reason.
  std::vector<Use> uses_beyond_seams(Index vertex, Index normal) const {
    std::vector<Use> beyond;
    if (leaders_.empty()) return beyond;
    const Index leader = leaders_[vertex];
    const auto before = [&](const Use& use, Index other) { return leaders_[use.vertex] < other; };
    auto use = std::lower_bound(seam_uses_.begin(), seam_uses_.end(), leader, before);
    for (; use != seam_uses_.end() && leaders_[use->vertex] == leader; ++use) {
      const auto& normals = mesh_.attributes().normals;
      const bool is_equal = (normals[use->normal] - normals[normal]).norm() <= kSameNormal;
      if (use->vertex != vertex && is_equal) beyond.push_back(*use);
    }
    return beyond;
  }

  bool moved(std::size_t face) const {
    if (rest_.empty()) return true;
    const auto vertices = mesh_.face(face);
    return std::any_of(vertices.begin(), vertices.end(),
                       [&](Index v) { return mesh_.positions[v] != rest_[v]; });
  }

  std::vector<Use> uses_of_changed_normals() const {
    std::vector<bool> changed(stored_.normals.size(), false);
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      if (!moved(f)) continue;
      for (Index c = mesh_.face_starts()[f]; c < mesh_.face_starts()[f + 1]; ++c) {
        if (normal_of(c) == kNoIndex) continue;
        changed[normal_of(c)] = true;
        for (const Use& use : uses_beyond_seams(mesh_.face_vertices()[c], normal_of(c))) {
          changed[use.normal] = true;
        }
      }
    }
    std::vector<Use> uses;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      for (Index c = mesh_.face_starts()[f]; c < mesh_.face_starts()[f + 1]; ++c) {
        const Index normal = normal_of(c);
        if (normal == kNoIndex || !changed[normal]) continue;
        uses.push_back({normal, mesh_.face_vertices()[c], c, static_cast<Index>(f)});
      }
    }
    std::sort(uses.begin(), uses.end());
    return uses;
  }

  // Sorted by corner, so that both sides of a seam get the same bits.
  std::vector<Use> with_those_beyond(std::span<const Use> uses) const {
    std::vector<Use> all = uses_beyond_seams(uses.front().vertex, uses.front().normal);
    all.insert(all.end(), uses.begin(), uses.end());
    std::ranges::sort(all, {}, &Use::corner);
    return all;
  }

  Group make_group(std::span<const Use> uses) const {
    Vector3d now = Vector3d::Zero();
    Vector3d before = Vector3d::Zero();
    for (const Use& use : with_those_beyond(uses)) {
      now += area_vector(mesh_.face(use.face), mesh_.positions);
      if (!rest_.empty()) before += area_vector(mesh_.face(use.face), rest_);
    }
    now = direction(now);
    before = direction(before);
    const bool changed = !now.isZero(0.0) && !((now - before).norm() <= kSameNormal);
    const bool inward = before.dot(stored_.normals[uses.front().normal]) < 0.0;
    return {uses, inward ? Vector3d(-now) : now, changed};
  }

  void update_normal(std::span<const Use> uses) {
    std::vector<Group> groups;
    for (auto begin = uses.begin(); begin != uses.end();) {
      const auto end =
          std::find_if(begin, uses.end(), [&](const Use& u) { return u.vertex != begin->vertex; });
      groups.push_back(make_group({begin, end}));
      begin = end;
    }
    bool free = std::all_of(groups.begin(), groups.end(), [](const Group& g) { return g.changed; });
    std::map<std::array<std::int64_t, 3>, Index> numbers;
    for (const Group& group : groups) {
      if (!group.changed) continue;
      const Eigen::Array3d scaled = (group.normal / kSameNormal).array().round();
      const auto [entry, added] = numbers.try_emplace(
          {static_cast<std::int64_t>(scaled.x()), static_cast<std::int64_t>(scaled.y()),
           static_cast<std::int64_t>(scaled.z())},
          uses.front().normal);
      if (added && free) {
        stored_.normals[uses.front().normal] = group.normal;
        free = false;
      } else if (added) {
        entry->second = static_cast<Index>(stored_.normals.size());
        stored_.normals.push_back(group.normal);
      }
      if (entry->second == uses.front().normal) continue;
      for (const Use& use : group.uses) stored_.corner_normals[use.corner] = entry->second;
    }
  }

  const Mesh& mesh_;
  std::span<const Vector3d> rest_;
  StoredNormals stored_;
  std::vector<Index> leaders_;  // JoinedSurface::leaders; empty without seams
  std::vector<Use> seam_uses_;  // by leader, then by corner
};

}  // namespace

StoredNormals updated_normals(const Mesh& mesh, std::span<const Vector3d> rest) {
  return NormalUpdate(mesh, rest).run();
}

StoredNormals computed_normals(const Mesh& mesh, double feature_angle_degrees) {
  const Topology& topology = mesh.topology();
  const SplitNormals split = split_normals(mesh.positions, topology, feature_angle_degrees);
  StoredNormals computed;
  computed.normals.assign(mesh.vertex_count() + split.extra_vertices.size(), Vector3d::Zero());
  computed.corner_normals = mesh.face_vertices();
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
    const Triangle& triangle = topology.triangles[t];
    const Vector3d& a = mesh.positions[triangle[0]];
    const Vector3d area = (mesh.positions[triangle[1]] - a).cross(mesh.positions[triangle[2]] - a);
    const auto polygon = mesh.face(topology.triangle_faces[t]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Index normal = split.of_corner[3 * t + k];
      computed.normals[normal] += area;
      for (std::size_t c = 0; c < polygon.size(); ++c) {
        if (polygon[c] != triangle[k]) continue;
        computed.corner_normals[mesh.face_starts()[topology.triangle_faces[t]] + c] = normal;
      }
    }
  }
  for (Vector3d& normal : computed.normals) normal = direction(normal);
  return computed;
}

}  // namespace lapwing
