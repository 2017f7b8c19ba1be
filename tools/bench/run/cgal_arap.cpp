#include "run/cgal_arap.h"

#include <optional>

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include "lapwing/base/errors.h"

namespace lapwing::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = SurfaceMesh::Vertex_index;

// Counts iterations, which CGAL does not report: each one asks once for each vertex's rotation.
struct CountingRotations : CGAL::Deformation_Eigen_polar_closest_rotation_traits_3 {
  static inline std::size_t count = 0;

  void compute_close_rotation(const Matrix& m, Matrix& R) {
    ++count;
    CGAL::Deformation_Eigen_polar_closest_rotation_traits_3::compute_close_rotation(m, R);
  }
};

SurfaceMesh as_surface_mesh(const Mesh& mesh) {
  SurfaceMesh surface;
  for (const Eigen::Vector3d& p : mesh.positions) surface.add_vertex({p.x(), p.y(), p.z()});
  for (const Triangle& t : mesh.topology().triangles) {
    const auto face = surface.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2]));
    if (face == SurfaceMesh::null_face()) throw InputError("not a manifold");
  }
  if (!surface.is_valid(false)) throw InputError("not a manifold");
  return surface;
}

template <CGAL::Deformation_algorithm_tag kTag>
class CgalArapOf final : public CgalArap {
 public:
  CgalArapOf(const Mesh& mesh, const EditRegion& region)
      : rest_(mesh.positions), region_(region), surface_(as_surface_mesh(mesh)) {}

  void prepare() override {
    deformation_.emplace(surface_);
    for (const Index v : region_.roi) deformation_->insert_roi_vertex(Vertex(v));
    for (const Index v : region_.belt) deformation_->insert_control_vertex(Vertex(v));
    for (const VertexSet& handle : region_.handles) {
      for (const Index v : handle) deformation_->insert_control_vertex(Vertex(v));
    }
    if (!deformation_->preprocess()) throw SolverError("CGAL could not factor its system");
  }

  void move(std::span<const Eigen::Affine3d> motions) override {
    for (std::size_t h = 0; h < motions.size(); ++h) {
      for (const Index v : region_.handles[h]) {
        const Eigen::Vector3d p = motions[h] * rest_[v];
        deformation_->set_target_position(Vertex(v), {p.x(), p.y(), p.z()});
      }
    }
  }

  int iterate(int most_iterations, double tolerance) override {
    CountingRotations::count = 0;
    deformation_->deform(static_cast<unsigned>(most_iterations), tolerance);
    return static_cast<int>(CountingRotations::count / region_.roi.size());
  }

  Positions positions() const override {
    Positions positions;
    for (const Vertex v : surface_.vertices()) {
      const auto& p = surface_.point(v);
      positions.emplace_back(p.x(), p.y(), p.z());
    }
    return positions;
  }

 private:
  Positions rest_;
  EditRegion region_;
  SurfaceMesh surface_;
  std::optional<CGAL::Surface_mesh_deformation<SurfaceMesh, CGAL::Default, CGAL::Default, kTag,
                                               CGAL::Default, CGAL::Default, CountingRotations>>
      deformation_;
};

}  // namespace

std::unique_ptr<CgalArap> make_cgal_arap(const Mesh& mesh, const EditRegion& region,
                                         ArapVariant variant) {
  if (variant == ArapVariant::original) {
    return std::make_unique<CgalArapOf<CGAL::ORIGINAL_ARAP>>(mesh, region);
  }
  return std::make_unique<CgalArapOf<CGAL::SPOKES_AND_RIMS>>(mesh, region);
}

}  // namespace lapwing::bench
