#include "lapwing/coating/mix_weight.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/errors.h"
#include "lapwing/region/geodesic.h"

namespace lapwing {
namespace {

std::vector<double> distances_to(const RegionSpec& spec, const Mesh& mesh) {
  const VertexSet region = resolve(spec, mesh);
  if (region.empty()) {
    throw InputError(spec.where + ": the region has no vertices; name at least one");
  }
  auto distances = geodesic_distances(mesh.topology(), mesh.positions, region);
  // Unreachable vertices get a finite distance, because infinity cannot be interpolated.
  double farthest = 0.0;
  for (const double d : distances) farthest = std::isfinite(d) ? std::max(farthest, d) : farthest;
  const double beyond = farthest + bounds_of(mesh.positions).diagonal();
  for (double& d : distances) d = std::isfinite(d) ? d : beyond;
  return distances;
}

void require_weights(const std::vector<double>& field, const Mesh& mesh, const std::string& where) {
  if (field.size() != mesh.vertex_count()) {
    throw InputError(where + "/field: expected one number for each of the target's " +
                     std::to_string(mesh.vertex_count()) + " vertices, got " +
                     std::to_string(field.size()));
  }
  for (std::size_t v = 0; v < field.size(); ++v) {
    if (field[v] >= 0.0 && field[v] <= 1.0) continue;
    throw InputError(where + "/field/" + std::to_string(v) +
                     ": expected a number from 0 to 1, got " + std::to_string(field[v]));
  }
}

// Computes the weights; one overload per form.
struct Weigher {
  const Transition::Profile profile;
  const std::span<const double> field;
  const Patch& patch;
  const DomainMap& map;
  const std::string& where;

  std::vector<double> operator()(const DomainRamp& ramp) const {
    if (map.domain != Domain::square) {
      throw InputError(where +
                       "/domain_v: only the square domain has a coordinate v; set \"domain\" to "
                       "\"square\", or use \"distance_to\"");
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
    std::vector<double> weights;
    for (const Index v : patch.vertices) {
      const bool sharp = ramp.width <= 0.0;
      weights.push_back(sharp ? (field[v] <= 0.0 ? 1.0 : 0.0)
                              : 1.0 - fade({ramp.width, profile}, field[v]));
    }
    return weights;
  }

  std::vector<double> operator()(const PaintedWeight&) const {
    std::vector<double> weights;
    for (const Index v : patch.vertices) weights.push_back(std::clamp(field[v], 0.0, 1.0));
    return weights;
  }
};

}  // namespace

std::vector<double> weight_field(const MixWeight& weight, const Mesh& mesh,
                                 const std::string& where) {
  if (const auto* ramp = std::get_if<DistanceRamp>(&weight.form)) {
    return distances_to(ramp->region, mesh);
  }
  const auto* painted = std::get_if<PaintedWeight>(&weight.form);
  if (painted == nullptr) return {};
  require_weights(painted->field, mesh, where);
  return painted->field;
}

std::vector<double> mix_weights(const MixWeight& weight, std::span<const double> field,
                                const Patch& patch, const DomainMap& map,
                                const std::string& where) {
  return std::visit(Weigher{weight.profile, field, patch, map, where}, weight.form);
}

}  // namespace lapwing
