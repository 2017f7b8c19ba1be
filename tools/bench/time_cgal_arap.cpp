#include "time_cgal_arap.h"

#include <memory>

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

namespace lapwing::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Deformation = CGAL::Surface_mesh_deformation<SurfaceMesh>;

SurfaceMesh as_surface_mesh(const Mesh& mesh, const Topology& topology) {
  SurfaceMesh surface;
  for (const Eigen::Vector3d& p : mesh.positions) surface.add_vertex({p.x(), p.y(), p.z()});
  for (const Triangle& t : topology.triangles) {
    surface.add_face(SurfaceMesh::Vertex_index(t[0]), SurfaceMesh::Vertex_index(t[1]),
                     SurfaceMesh::Vertex_index(t[2]));
  }
  return surface;
}

}  // namespace

Samples time_cgal_arap(const Mesh& mesh, const Topology& topology, const EditRegion& region,
                       int repeats) {
  SurfaceMesh surface = as_surface_mesh(mesh, topology);
  std::unique_ptr<Deformation> deformation;
  Samples samples;
  for (int i = 0; i < repeats; ++i) {
    deformation = std::make_unique<Deformation>(surface);
    for (const Index v : region.roi) deformation->insert_roi_vertex(SurfaceMesh::Vertex_index(v));
    const auto hold = [&](const VertexSet& vertices) {
      for (const Index v : vertices) {
        deformation->insert_control_vertex(SurfaceMesh::Vertex_index(v));
      }
    };
    hold(region.belt);
    for (const VertexSet& handle : region.handles) hold(handle);
    const Stopwatch watch;
    if (!deformation->preprocess()) throw std::runtime_error("CGAL could not factor its system");
    samples.milliseconds.push_back(watch.elapsed_ms());
  }
  return samples;
}

}  // namespace lapwing::bench
