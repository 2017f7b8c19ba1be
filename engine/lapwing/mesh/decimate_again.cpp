#include <algorithm>
#include <numeric>

#include "lapwing/mesh/decimate.h"

namespace lapwing {
namespace {

// Per vertex the one that it goes into, itself where it stays. A merge is as good as it was where
// the triangles around both of its vertices are those of then; they are not where a merge beside
// them was left out.
std::vector<Index> merged_again(const MergeHistory& before, std::span<const Index> groups) {
  std::vector<Index> owners(groups.size());
  std::iota(owners.begin(), owners.end(), Index{0});
  std::vector<char> differs(groups.size(), 0);
  for (std::size_t k = 0; k < before.merges.size(); ++k) {
    const auto [from, into] = before.merges[k];
    const bool may = groups[from] == groups[into] && groups[from] != kKeptGroup;
    if (may && differs[from] == 0 && differs[into] == 0) {
      owners[from] = into;
      continue;
    }
    differs[from] = 1;
    for (const Index v : before.beside[k]) differs[v] = 1;
  }
  // The last merges first, so that what a vertex went into is at its end.
  for (auto merge = before.merges.rbegin(); merge != before.merges.rend(); ++merge) {
    const Index from = (*merge)[0];
    owners[from] = owners[owners[from]];
  }
  return owners;
}

std::vector<Triangle> merged(std::span<const Triangle> triangles, std::span<const Index> owners) {
  std::vector<Triangle> left;
  for (const auto& [a, b, c] : triangles) {
    const Triangle t{owners[a], owners[b], owners[c]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) left.push_back(t);
  }
  return left;
}

}  // namespace

std::optional<Decimated> decimate_again(const MergeHistory& before,
                                        std::span<const Eigen::Vector3d> positions,
                                        std::span<const Triangle> triangles,
                                        std::span<const Index> groups, std::size_t count) {
  const std::vector<Index> owners = merged_again(before, groups);
  NumberedTriangles near = numbered(merged(triangles, owners));
  if (near.vertices.size() > positions.size() / 2) return std::nullopt;
  std::vector<Eigen::Vector3d> near_positions;
  std::vector<Index> near_groups;
  for (const Index v : near.vertices) {
    near_positions.push_back(positions[v]);
    near_groups.push_back(groups[v]);
  }
  Decimated result = decimate(near_positions, std::move(near.triangles), near_groups, count);
  const std::vector<Index> places = places_in(near.vertices, positions.size());
  const auto owner = [&](Index v) {
    const Index place = places[owners[v]];
    return place == kNoIndex ? kNoIndex : result.owners[place];
  };
  std::vector<Index> all_owners(positions.size());
  for (Index v = 0; v < positions.size(); ++v) all_owners[v] = owner(v);
  result.owners = std::move(all_owners);
  for (Index& v : result.kept) v = near.vertices[v];
  result.history = {};
  return result;
}

}  // namespace lapwing
