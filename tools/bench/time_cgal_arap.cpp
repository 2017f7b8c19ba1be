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
using Vertex = SurfaceMesh::Vertex_index;

// CGAL tells nobody how many iterations it took: every one asks for each vertex's rotation once.
struct CountingRotations : CGAL::Deformation_Eigen_polar_closest_rotation_traits_3 {
  static inline std::size_t count = 0;

  void compute_close_rotation(const Matrix& m, Matrix& R) {
    ++count;
    CGAL::Deformation_Eigen_polar_closest_rotation_traits_3::compute_close_rotation(m, R);
  }
};

template <CGAL::Deformation_algorithm_tag kTag>
using DeformationBy =
    CGAL::Surface_mesh_deformation<SurfaceMesh, CGAL::Default, CGAL::Default, kTag, CGAL::Default,
                                   CGAL::Default, CountingRotations>;

SurfaceMesh as_surface_mesh(const Mesh& mesh, const Topology& topology) {
  SurfaceMesh surface;
  for (const Eigen::Vector3d& p : mesh.positions) surface.add_vertex({p.x(), p.y(), p.z()});
  for (const Triangle& t : topology.triangles) {
    surface.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2]));
  }
  return surface;
}

template <typename Deformation>
void choose_region(Deformation& deformation, const EditRegion& region) {
  for (const Index v : region.roi) deformation.insert_roi_vertex(Vertex(v));
  for (const Index v : region.belt) deformation.insert_control_vertex(Vertex(v));
  for (const VertexSet& handle : region.handles) {
    for (const Index v : handle) deformation.insert_control_vertex(Vertex(v));
  }
}

template <typename Deformation>
void prepare(Deformation& deformation) {
  if (!deformation.preprocess()) throw std::runtime_error("CGAL could not factor its system");
}

template <CGAL::Deformation_algorithm_tag kTag>
ArapResult deform(const Mesh& mesh, const Topology& topology, const EditRegion& region,
                  std::span<const Eigen::Affine3d> motions, int max_iterations, int repeats) {
  SurfaceMesh surface = as_surface_mesh(mesh, topology);
  DeformationBy<kTag> deformation(surface);
  choose_region(deformation, region);
  prepare(deformation);
  ArapResult result;
  result.frame = measure(repeats, [&] {
    deformation.reset();
    CountingRotations::count = 0;
    for (std::size_t h = 0; h < region.handles.size(); ++h) {
      for (const Index v : region.handles[h]) {
        const Eigen::Vector3d p = motions[h] * mesh.positions[v];
        deformation.set_target_position(Vertex(v), {p.x(), p.y(), p.z()});
      }
    }
    deformation.deform(static_cast<unsigned>(max_iterations), deformation.tolerance());
  });
  result.iterations = static_cast<int>(CountingRotations::count / region.roi.size());
  for (const Vertex v : surface.vertices()) {
    const auto& p = surface.point(v);
    result.positions.emplace_back(p.x(), p.y(), p.z());
  }
  return result;
}

}  // namespace

Samples time_cgal_arap(const Mesh& mesh, const Topology& topology, const EditRegion& region,
                       int repeats) {
  SurfaceMesh surface = as_surface_mesh(mesh, topology);
  std::unique_ptr<DeformationBy<CGAL::SPOKES_AND_RIMS>> deformation;
  Samples samples;
  for (int i = 0; i < repeats; ++i) {
    deformation = std::make_unique<DeformationBy<CGAL::SPOKES_AND_RIMS>>(surface);
    choose_region(*deformation, region);
    const Stopwatch watch;
    prepare(*deformation);
    samples.milliseconds.push_back(watch.elapsed_ms());
  }
  return samples;
}

ArapResult deform_by_cgal_arap(const Mesh& mesh, const Topology& topology, const EditRegion& region,
                               std::span<const Eigen::Affine3d> motions, ArapVariant variant,
                               int max_iterations, int repeats) {
  return variant == ArapVariant::original
             ? deform<CGAL::ORIGINAL_ARAP>(mesh, topology, region, motions, max_iterations, repeats)
             : deform<CGAL::SRE_ARAP>(mesh, topology, region, motions, max_iterations, repeats);
}

}  // namespace lapwing::bench
