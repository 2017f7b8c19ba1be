#include "lapwing/region/stiffness.h"

#include <sstream>
#include <string>

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

void require_stiffness(const StiffnessSpec& spec, const Mesh& mesh) {
  const auto fail = [&](const std::string& whose, double factor, std::vector<Index> vertices) {
    std::ostringstream text;
    text << spec.region.where << ": " << whose << " must be " << kStiffnessWords << ", not "
         << factor;
    throw InputError(text.str(), std::move(vertices));
  };
  if (spec.field.empty()) {
    if (!is_stiffness(spec.factor)) fail("the stiffness", spec.factor, {});
    return;
  }
  if (spec.field.size() != mesh.vertex_count()) {
    throw InputError(spec.region.where + ": expected a stiffness for each of the mesh's " +
                     std::to_string(mesh.vertex_count()) + " vertices, got " +
                     std::to_string(spec.field.size()));
  }
  for (Index v = 0; v < spec.field.size(); ++v) {
    if (is_stiffness(spec.field[v])) continue;
    fail("the stiffness of vertex " + std::to_string(v), spec.field[v], {v});
  }
}

}  // namespace

std::vector<VertexStiffness> resolve_stiffness(std::span<const StiffnessSpec> specs,
                                               const VertexSet& roi, const Mesh& mesh) {
  if (specs.empty()) return {};
  std::vector<double> factors(mesh.vertex_count(), 1.0);
  for (const StiffnessSpec& spec : specs) {
    require_stiffness(spec, mesh);
    for (const Index v : resolve(spec.region, mesh)) {
      factors[v] = spec.field.empty() ? spec.factor : spec.field[v];
    }
  }
  std::vector<VertexStiffness> stiffness;
  for (const Index v : roi) {
    if (factors[v] != 1.0) stiffness.push_back({v, factors[v]});
  }
  return stiffness;
}

}  // namespace lapwing
