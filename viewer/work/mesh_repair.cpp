#include "work/mesh_repair.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing::viewer {
namespace {

void append_vertices(const Mesh& mesh, const Defect& defect, std::vector<Index>& vertices) {
  switch (describe(defect.kind).element) {
    case Element::none:
      break;
    case Element::vertex:
    case Element::edge:
    case Element::component:
    case Element::rim:
      vertices.insert(vertices.end(), defect.first.begin(), defect.first.end());
      break;
    case Element::face:
      for (const Index face : defect.first) {
        const auto corners = mesh.face(face);
        vertices.insert(vertices.end(), corners.begin(), corners.end());
      }
      break;
  }
}

bool is_finite(const Mesh& mesh, Index vertex) {
  return mesh.positions[vertex].allFinite();
}

}  // namespace

RepairedMesh repaired(const Mesh& mesh, const Progress& progress) {
  report_progress(progress, "repair", 0.0);
  Mesh copy = mesh;
  RepairedMesh result;
  result.done = fix(copy);
  report_progress(progress, "topology", 0.0);
  copy.topology();
  report_progress(progress, "check", 0.0);
  result.left = check(copy);
  result.mesh = std::make_shared<const Mesh>(std::move(copy));
  return result;
}

FaultyVertices faulty_vertices(const Mesh& mesh, const CheckReport& report) {
  FaultyVertices faulty;
  for (const Defect& defect : report.defects) {
    const Severity severity = describe(defect.kind).severity;
    if (severity == Severity::info) continue;
    append_vertices(mesh, defect, severity == Severity::error ? faulty.hindering : faulty.others);
  }
  return {make_vertex_set(std::move(faulty.hindering)), make_vertex_set(std::move(faulty.others))};
}

std::vector<Index> places_of(const Mesh& mesh, const FaultyVertices& vertices) {
  std::vector<Index> places;
  VertexSet nowhere;
  for (const Index v : unite(vertices.hindering, vertices.others)) {
    (is_finite(mesh, v) ? places : nowhere).push_back(v);
  }
  const std::vector<char> is_nowhere = vertex_mask(mesh.vertex_count(), nowhere);
  for (Index f = 0; !nowhere.empty() && f < mesh.face_count(); ++f) {
    const auto corners = mesh.face(f);
    if (std::ranges::none_of(corners, [&](Index v) { return is_nowhere[v] != 0; })) continue;
    std::ranges::copy_if(corners, std::back_inserter(places),
                         [&](Index v) { return is_finite(mesh, v); });
  }
  return make_vertex_set(std::move(places));
}

std::optional<Eigen::Vector3d> side_of(const Mesh& mesh, std::span<const Index> places) {
  // If the mean of the normals is shorter than this, they have no common direction.
  constexpr double kShortMean = 0.3;
  const std::vector<char> is_place = vertex_mask(mesh.vertex_count(), places);
  const Eigen::Vector3d center = bounds_of(mesh.positions).center();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const auto& [a, b, c] : mesh.topology().triangles) {
    if (is_place[a] + is_place[b] + is_place[c] == 0) continue;
    const Eigen::Vector3d& corner = mesh.positions[a];
    const Eigen::Vector3d normal =
        (mesh.positions[b] - corner).cross(mesh.positions[c] - corner).stableNormalized();
    if (!normal.allFinite() || normal.isZero()) continue;
    sum += normal.dot(corner - center) < 0.0 ? Eigen::Vector3d(-normal) : normal;
    count += 1.0;
  }
  if (count == 0.0 || sum.norm() < kShortMean * count) return {};
  return sum.normalized();
}

}  // namespace lapwing::viewer
