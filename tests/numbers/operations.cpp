#include "numbers/operations.h"

#include <algorithm>
#include <cmath>

#include "coating/coating_scenes.h"
#include "lapwing/lapwing.h"
#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"

namespace lapwing::test {
namespace {

constexpr std::size_t kMostEdited = 300;

// Returns at most kMostEdited vertices around one vertex of the largest component, in the order of
// a breadth-first search.
std::vector<Index> around_the_middle(const Mesh& mesh) {
  const Topology& topology = mesh.topology();
  const Components components = connected_components(topology.rings);
  std::vector<std::size_t> sizes(components.count, 0);
  for (const Index c : components.of_vertex) ++sizes[c];
  const auto largest =
      static_cast<Index>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::vector<Index> inside;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (components.of_vertex[v] == largest) inside.push_back(v);
  }
  std::vector<Index> order{inside[inside.size() / 2]};
  std::vector<char> seen(mesh.vertex_count(), 0);
  seen[order[0]] = 1;
  for (std::size_t at = 0; at < order.size() && order.size() < kMostEdited; ++at) {
    for (const Index w : topology.rings[order[at]]) {
      if (seen[w] == 0) order.push_back(w);
      seen[w] = 1;
    }
  }
  return order;
}

RegionSpec patch_of(const Mesh& mesh) {
  return {DiskInRegion{{{ListedVertices{around_the_middle(mesh)}}}}};
}

double size_of(const Mesh& mesh) {
  return bounds_of(mesh.positions).diagonal();
}

Mesh with_positions(const Mesh& mesh, Positions positions) {
  Mesh result = mesh;
  result.positions = std::move(positions);
  return result;
}

// The height of the source's detail, relative to the size of the target.
constexpr double kDetail = 0.02;

// A bumpy square as large as the mesh.
Mesh source_for(const Mesh& plain, const Placement& placement, double waves) {
  Mesh source = uneven_relief(16, waves, kDetail, 7);
  for (Eigen::Vector3d& p : source.positions) p *= size_of(plain);
  return placement(std::move(source));
}

CoatSource all_of_it(double detail_size) {
  CoatSource source;
  source.patch = {AllVertices{}};
  source.detail_size = detail_size;
  return source;
}

Mesh run_deform(const Mesh& plain, const Placement& placement) {
  const std::vector<Index> order = around_the_middle(plain);
  const auto size = static_cast<std::ptrdiff_t>(order.size());
  const auto handle = std::max<std::ptrdiff_t>(size / 20, 1);
  const auto belt = std::min(std::max<std::ptrdiff_t>(size / 5, 7), size - handle);
  DeformRequest request;
  request.roi = {ListedVertices{order}};
  request.belt = RegionSpec{ListedVertices{{order.end() - belt, order.end()}}};
  request.handles = {{{ListedVertices{{order.begin(), order.begin() + handle}}},
                      SimilarityMove{.translate = placement.scale * size_of(plain) *
                                                  Eigen::Vector3d(0.03, 0.05, 0.02),
                                     .rotate = {{1.0, 2.0, -1.0}, 25.0}}}};
  const Mesh placed = placement(plain);
  return with_positions(plain, placement.back(deform(placed, request).mesh.positions));
}

Mesh run_peel(const Mesh& plain, const Placement& placement) {
  PeelRequest request;
  request.region = patch_of(plain);
  request.detail_size = placement.scale * 0.1 * size_of(plain);
  return with_positions(plain, placement.back(peel(placement(plain), request).mesh.positions));
}

Mesh run_remesh(const Mesh& plain, const Placement& placement) {
  RemeshRequest request;
  request.region = patch_of(plain);
  request.scale = 0.8;
  Mesh result = remesh(placement(plain), request).mesh;
  result.positions = placement.back(std::move(result.positions));
  return result;
}

Mesh run_parameterize(const Mesh& plain, const Placement& placement) {
  ParameterizeRequest request;
  request.region = patch_of(plain);
  const Parameterized laid = parameterize(placement(plain), request);
  Mesh result = with_positions(plain, Positions(plain.vertex_count(), Eigen::Vector3d::Zero()));
  for (Index own = 0; own < laid.patch.vertices.size(); ++own) {
    result.positions[laid.patch.vertices[own]].head<2>() = laid.map.points[own];
  }
  return result;
}

Mesh run_coat(const Mesh& plain, const Placement& placement) {
  const double size = placement.scale * size_of(plain);
  CoatRequest request;
  request.source = all_of_it(0.5 * size);
  request.target_patch = patch_of(plain);
  request.parameters.smooth_target = 0.05 * size;
  request.parameters.remesh = Remeshing::none;
  Coated coated = coat(placement(plain), source_for(plain, placement, 3.0), request);
  return with_positions(plain, placement.back(std::move(coated.mesh.positions)));
}

Mesh run_mix(const Mesh& plain, const Placement& placement) {
  const double size = placement.scale * size_of(plain);
  MixRequest request;
  request.sources = {all_of_it(0.5 * size), all_of_it(0.3 * size)};
  request.target_patch = patch_of(plain);
  request.parameters.remesh = Remeshing::none;
  std::vector<double> field(plain.vertex_count());
  for (std::size_t v = 0; v < field.size(); ++v) field[v] = static_cast<double>(v % 3) / 2.0;
  request.weight.form = PaintedWeight{std::move(field)};
  Coated mixed = mix(placement(plain), source_for(plain, placement, 3.0),
                     source_for(plain, placement, 2.0), request);
  return with_positions(plain, placement.back(std::move(mixed.mesh.positions)));
}

// Removes the vertices in the middle and fills the hole.
Mesh run_fill(const Mesh& plain, const Placement& placement) {
  const std::vector<Index> order = around_the_middle(plain);
  KeepMask keep(plain.vertex_count(), 1);
  for (std::size_t k = 0; k < std::max<std::size_t>(order.size() / 20, 1); ++k) keep[order[k]] = 0;
  Mesh open = plain;
  keep_vertices(open, keep);
  Mesh result = fill_holes(placement(open), FillRequest{}).mesh;
  result.positions = placement.back(std::move(result.positions));
  return result;
}

// Replaces a small disk by a dome. The size of the dome is a third of the mesh size.
Mesh run_transplant(const Mesh& plain, const Placement& placement) {
  Mesh dome = uneven_relief(10, 1.0, 0.05, 3);
  for (Eigen::Vector3d& p : dome.positions) p *= 0.3 * size_of(plain);
  TransplantRequest request;
  const std::vector<Index> order = around_the_middle(plain);
  const std::size_t cut = std::max<std::size_t>(order.size() / 6, 1);
  request.target_region = {
      DiskInRegion{{{ListedVertices{{order.begin(), order.begin() + static_cast<long>(cut)}}}}}};
  Mesh result = transplant(placement(plain), placement(std::move(dome)), request).mesh;
  result.positions = placement.back(std::move(result.positions));
  return result;
}

}  // namespace

std::vector<Operation> all_operations() {
  return {{"deform", run_deform},
          {"peel", run_peel},
          {"remesh", run_remesh},
          {"fill_holes", run_fill},
          {"parameterize", run_parameterize},
          {"coat", run_coat},
          {"mix", run_mix},
          {"transplant", run_transplant}};
}

Outcome outcome_of(const Operation& operation, const Mesh& plain, const Placement& placement) {
  try {
    return {operation.run(plain, placement), ""};
  } catch (const Error& error) {
    return {{}, error.what()};
  }
}

namespace {

// Returns the largest distance between `surface` and a vertex of `mesh`. Ignores isolated vertices.
double distance_from(const Mesh& surface, const Mesh& mesh) {
  const Topology& topology = surface.topology();
  const ClosestPoint closest(topology.triangles, surface.positions);
  double largest = 0.0;
  for (const Index v : mesh.face_vertices()) {
    const Eigen::Vector3d& p = mesh.positions[v];
    largest = std::max(largest, (closest.find(0, p).position - p).norm());
  }
  return largest;
}

bool same_positions(const Mesh& a, const Mesh& b, double tolerance) {
  for (std::size_t v = 0; v < a.vertex_count(); ++v) {
    // Vertices that are not finite in `b` also count as equal.
    if (a.positions[v] == b.positions[v] || !b.positions[v].allFinite()) continue;
    if (!((a.positions[v] - b.positions[v]).norm() <= tolerance)) return false;
  }
  return true;
}

}  // namespace

bool agrees(const Mesh& result, const Mesh& expected, double diagonal) {
  if (result.vertex_count() == expected.vertex_count() &&
      result.face_vertices() == expected.face_vertices()) {
    return same_positions(result, expected, kAgreement * diagonal);
  }
  const auto count = static_cast<double>(expected.vertex_count());
  return std::abs(static_cast<double>(result.vertex_count()) - count) <= kSameCount * count &&
         distance_from(result, expected) <= kSameSurface * diagonal &&
         distance_from(expected, result) <= kSameSurface * diagonal;
}

}  // namespace lapwing::test
