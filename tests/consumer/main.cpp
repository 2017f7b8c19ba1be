// Lifts the middle of a generated sheet, on the CPU so that it runs anywhere.
#include <cstdio>
#include <lapwing/deform/deformer.h>
#include <lapwing/io/mesh_file.h>
#include <lapwing/mesh/shapes.h>
#include <lapwing/vulkan/open_device.h>

int main() {
  lapwing::Mesh mesh = lapwing::grid(10, 10);
  const lapwing::Topology topology = lapwing::build_topology(mesh);
  lapwing::EditRegion region;
  for (lapwing::Index v = 0; v < mesh.vertex_count(); ++v) {
    region.roi.push_back(v);
    if (v < 11 || v >= 110 || v % 11 == 0 || v % 11 == 10) region.belt.push_back(v);
  }
  region.handles = {{60}};
  const auto kernels = lapwing::open_device("cpu");
  lapwing::Deformer deformer(mesh.positions, topology, region, {.hard = true}, *kernels);
  const Eigen::Affine3d lift(Eigen::Translation3d(0, 0, 0.3));
  mesh.positions = deformer.solve(std::array{lift}).positions;
  lapwing::write_mesh(mesh, "lifted.obj");
  std::printf("middle at %.3f\n", mesh.positions[60].z());
  return mesh.positions[60].z() > 0.1 && mesh.positions[0].z() == 0.0 ? 0 : 1;
}
