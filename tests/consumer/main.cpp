// Runs every operation on generated meshes, without files.
#include <cmath>
#include <cstdio>
#include <lapwing/kernels/cpu_kernels.h>
#include <lapwing/lapwing.h>
#include <lapwing/mesh/shapes.h>
#include <lapwing/render/render_image.h>
#include <lapwing/vulkan/vulkan_kernels.h>

using namespace lapwing;

namespace {

int failures = 0;

void expect(bool holds, const char* what) {
  std::printf("%s: %s\n", what, holds ? "yes" : "NO");
  failures += holds ? 0 : 1;
}

Mesh bumpy_sheet(double height) {
  Mesh mesh = grid(24, 24);
  for (auto& p : mesh.positions) p.z() = height * std::sin(25.0 * p.x()) * std::sin(25.0 * p.y());
  return mesh;
}

double highest(const Mesh& mesh) {
  double z = 0.0;
  for (const auto& p : mesh.positions) z = std::max(z, p.z());
  return z;
}

// Requests are written with designated initializers, as users write them. All other fields have
// defaults, so the compiler does not warn.
CoatSource all_of_it() {
  return {.patch = {AllVertices{}}, .detail_size = 0.5};
}

}  // namespace

int main() {
  const Mesh sheet = grid(24, 24);

  DeformRequest lift;
  lift.roi = {AllVertices{}};
  lift.handles = {{{ListedVertices{{312}}}, SimilarityMove{.translate = {0.0, 0.0, 0.3}}}};
  lift.parameters.hard = true;
  const Deformed lifted = deform(sheet, lift);
  expect(lifted.mesh.positions[312].z() == 0.3 && lifted.mesh.positions[0].z() == 0.0,
         "the middle of a sheet is lifted");
  const Eigen::MatrixX3d V = vertex_matrix(sheet);
  const Eigen::MatrixX3i F = triangle_matrix(sheet);
  expect(vertex_matrix(deform(V, F, lift).mesh) == vertex_matrix(lifted.mesh),
         "and so it is as two matrices");

  const CoatRequest bumps{.source = all_of_it(), .target_patch = {AllVertices{}}};
  const Coated coated = coat(sheet, bumpy_sheet(0.01), bumps);
  expect(highest(coated.mesh) > 0.003, "a sheet has the bumps of another");

  MixRequest half;
  half.sources = {all_of_it(), all_of_it()};
  half.target_patch = {AllVertices{}};
  half.weight.form = PaintedWeight{std::vector<double>(sheet.vertex_count(), 0.5)};
  const Coated mixed = mix(sheet, bumpy_sheet(0.01), bumpy_sheet(-0.01), half);
  expect(highest(mixed.mesh) < 0.001, "bumps and dents make half of nothing");

  const Mesh ball = icosphere(4);
  const TransplantRequest horn{.part_region = {{Box{{-2.0, -2.0, 0.5}, {2.0, 2.0, 2.0}}}},
                               .target_region = {Box{{0.8, -2.0, -2.0}, {2.0, 2.0, 2.0}}}};
  const Transplanted joined = transplant(ball, ball, horn);
  expect(joined.report.part_vertices > 0 && joined.mesh.face_count() > 0,
         "the cap of a ball is on its side");

  const Mesh bumpy = bumpy_sheet(0.01);
  const PeelRequest flatten{.detail_size = 0.5};
  const Peeled peeled = peel(bumpy, flatten);
  expect(highest(peeled.mesh) < 0.002, "a sheet loses its bumps");
  const Mesh carrying = with_coating(bumpy, flatten, peeled, CarriedCoating::height);
  expect(carrying.attributes().vertex_extras.size() == 1, "and keeps them as numbers");

  const ParameterizeRequest lay{.domain = Domain::square};
  const Parameterized laid = parameterize(bumpy, lay);
  expect(laid.flipped.empty() && laid.mesh.attributes().uvs.size() == bumpy.vertex_count(),
         "a sheet is laid into the square");

  const RemeshRequest finer{.scale = 0.5};
  const Remeshed fine = remesh(sheet, finer);
  expect(fine.mesh.vertex_count() > 2 * sheet.vertex_count() &&
             fine.after.mean_edge < 0.7 * fine.before.mean_edge,
         "a sheet gets finer triangles");

  const Mesh tube = cylinder(12, 5, 1.0, 4.0);
  expect(find_holes(fill_holes(tube, find_holes(tube)).mesh).empty(),
         "the holes of a tube are filled");
  expect(decimate(tube, {.share = 0.5}).mesh.vertex_count() < tube.vertex_count(),
         "a tube has fewer vertices");
  expect(subdivide(tube, {.times = 1}).face_count() == 4 * tube.face_count(),
         "a tube has more triangles");

  CpuKernels kernels;
  Mesh egg = ball;
  for (auto& p : egg.positions) p.z() *= 1.5;
  const Mesh coarse = icosphere(3);
  const Wrapped wrapped = wrap(coarse, egg, {.aligned = true}, kernels);
  expect(wrapped.report.coverage > 0.99 && wrapped.report.to_scan.max < 0.02,
         "a ball covers an egg");
  const TransferSolver poses(ball, coarse, {.aligned = true}, kernels);
  Mesh longer = coarse;
  longer.positions = poses.solve(egg.positions).positions;
  expect(std::abs(highest(longer) - 1.5) < 0.02, "a ball takes over the pose of another");
  return failures;
}
