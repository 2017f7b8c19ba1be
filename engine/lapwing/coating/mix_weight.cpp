#include "lapwing/coating/mix_weight.h"

#include <algorithm>

#include "lapwing/base/errors.h"
#include "lapwing/region/geodesic.h"

namespace lapwing {
namespace {

// One overload per form.
struct Weigher {
  const Transition::Profile profile;
  const Patch& patch;
  const DomainMap& map;
  const Mesh& mesh;
  const Topology& topology;
  const std::string& where;

  std::vector<double> operator()(const DomainRamp& ramp) const {
    if (map.domain != Domain::square) {
      throw InputError(where +
                       "/domain_v: only the square domain has a v; write \"domain\": "
                       "\"square\" in the first source, or weigh by distance");
    }
    if (ramp.from == ramp.to) {
      throw InputError(where + "/domain_v: the ramp has no extent; give two different numbers");
    }
    std::vector<double> weights;
    for (std::size_t own = 0; own < patch.vertices.size(); ++own) {
      const double share = (map.points[own].y() - ramp.from) / (ramp.to - ramp.from);
      weights.push_back(fade({1.0, profile}, share));
    }
    return weights;
  }

  std::vector<double> operator()(const DistanceRamp& ramp) const {
    const VertexSet region = resolve(ramp.region, mesh, topology);
    const auto distances = geodesic_distances(topology, mesh.positions, region, ramp.width);
    std::vector<double> weights;
    for (const Index v : patch.vertices) {
      const bool sharp = ramp.width <= 0.0;
      weights.push_back(sharp ? (distances[v] <= 0.0 ? 1.0 : 0.0)
                              : 1.0 - fade({ramp.width, profile}, distances[v]));
    }
    return weights;
  }

  std::vector<double> operator()(const PaintedWeight& painted) const {
    if (painted.field.size() != mesh.vertex_count()) {
      throw InputError(where + "/field: expected one number for each of the target's " +
                       std::to_string(mesh.vertex_count()) + " vertices, got " +
                       std::to_string(painted.field.size()));
    }
    std::vector<double> weights;
    for (const Index v : patch.vertices) {
      if (!(painted.field[v] >= 0.0 && painted.field[v] <= 1.0)) {
        throw InputError(where + "/field/" + std::to_string(v) + ": expected 0 to 1, got " +
                         std::to_string(painted.field[v]));
      }
      weights.push_back(painted.field[v]);
    }
    return weights;
  }
};

}  // namespace

std::vector<double> mix_weights(const MixWeight& weight, const Patch& patch, const DomainMap& map,
                                const Mesh& mesh, const Topology& topology,
                                const std::string& where) {
  return std::visit(Weigher{weight.profile, patch, map, mesh, topology, where}, weight.form);
}

}  // namespace lapwing
