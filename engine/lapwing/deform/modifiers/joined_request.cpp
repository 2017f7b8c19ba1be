#include "lapwing/deform/modifiers/joined_request.h"

#include <algorithm>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/joined_regions.h"

namespace lapwing {
namespace {

std::size_t joined_edges_in(const VertexSet& roi, const JoinedSurface& joined) {
  const std::vector<char> inside = vertex_mask(joined.leaders.size(), roi);
  return static_cast<std::size_t>(std::ranges::count_if(
      joined.edges, [&](const auto& ends) { return inside[ends[0]] && inside[ends[1]]; }));
}

// Returns the index in the mesh for each triangle of the joined surface. The joined surface does
// not contain the triangles that joining makes degenerate.
std::vector<Index> triangles_of_mesh(const JoinedSurface& joined, const Topology& topology) {
  std::vector<Index> numbers;
  for (Index t = 0; t < topology.triangles.size(); ++t) {
    const auto& [a, b, c] = topology.triangles[t];
    const std::array<Index, 3> led{joined.leaders[a], joined.leaders[b], joined.leaders[c]};
    if (led[0] != led[1] && led[1] != led[2] && led[2] != led[0]) numbers.push_back(t);
  }
  return numbers;
}

}  // namespace

DeformRequest joined_request(DeformRequest request, const JoinedSurface& joined) {
  request.roi = led(request.roi, joined);
  request.belt = led(request.belt, joined);
  for (MovedHandle& handle : request.handles) {
    handle.region = led(handle.region, joined);
    handle.falloff = led(std::move(handle.falloff), joined);
  }
  request.targets = led(std::move(request.targets), joined);
  for (StiffnessSpec& spec : request.stiffness) spec = led(std::move(spec), joined);
  return request;
}

void give_back_seams(const JoinedSurface& joined, Mesh mesh, const std::string& where,
                     Deformed& result) {
  if (const std::size_t count = joined_edges_in(result.region.roi, joined); count > 0) {
    result.notes.push_back(where + ": " + std::to_string(count) +
                           " seam edges of the ROI are joined, so both sides move as one surface");
  }
  result.region = with_followers(std::move(result.region), joined);
  if (std::vector<Index>& flipped = result.certificate.first_flipped_triangles; !flipped.empty()) {
    const std::vector<Index> numbers = triangles_of_mesh(joined, mesh.topology());
    for (Index& t : flipped) {
      if (t < numbers.size()) t = numbers[t];
    }
  }
  for (const Index v : joined.followers) {
    if (!result.rest_stretch.empty()) {
      result.rest_stretch[v] = result.rest_stretch[joined.leaders[v]];
    }
  }
  mesh.positions = std::move(result.mesh.positions);
  joined.close(mesh.positions);
  result.mesh = std::move(mesh);
}

}  // namespace lapwing
