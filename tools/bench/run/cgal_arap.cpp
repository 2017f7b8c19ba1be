#include "run/cgal_arap.h"

#include <memory>
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

template <CGAL::Deformation_algorithm_tag kTag>
using DeformationBy =
    CGAL::Surface_mesh_deformation<SurfaceMesh, CGAL::Default, CGAL::Default, kTag, CGAL::Default,
                                   CGAL::Default, CountingRotations>;

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

}  // namespace

struct CgalArap::State {
  State(const Mesh& mesh, const EditRegion& edit_region)
      : rest(mesh.positions), region(edit_region), surface(as_surface_mesh(mesh)) {}
  virtual ~State() = default;
  virtual void prepare() = 0;
  virtual void reset() = 0;
  virtual void set_target(Vertex v, const Kernel::Point_3& place) = 0;
  virtual void deform(unsigned iterations, double tolerance) = 0;

  Positions rest;
  EditRegion region;
  SurfaceMesh surface;
};

template <int kVariant>
struct CgalArap::StateOf final : CgalArap::State {
  using State::State;
  using Deformation = DeformationBy<static_cast<CGAL::Deformation_algorithm_tag>(kVariant)>;

  void prepare() override {
    deformation.emplace(surface);
    for (const Index v : region.roi) deformation->insert_roi_vertex(Vertex(v));
    for (const Index v : region.belt) deformation->insert_control_vertex(Vertex(v));
    for (const VertexSet& handle : region.handles) {
      for (const Index v : handle) deformation->insert_control_vertex(Vertex(v));
    }
    if (!deformation->preprocess()) throw SolverError("CGAL could not factor its system");
  }
  void reset() override { deformation->reset(); }
  void set_target(Vertex v, const Kernel::Point_3& place) override {
    deformation->set_target_position(v, place);
  }
  void deform(unsigned iterations, double tolerance) override {
    deformation->deform(iterations, tolerance);
  }

  std::optional<Deformation> deformation;
};

CgalArap::CgalArap(const Mesh& mesh, const EditRegion& region, ArapVariant variant) {
  switch (variant) {
    case ArapVariant::spokes_and_rims:
      state_ = std::make_unique<StateOf<CGAL::SPOKES_AND_RIMS>>(mesh, region);
      break;
    case ArapVariant::original:
      state_ = std::make_unique<StateOf<CGAL::ORIGINAL_ARAP>>(mesh, region);
      break;
    case ArapVariant::smooth_rotations:
      state_ = std::make_unique<StateOf<CGAL::SRE_ARAP>>(mesh, region);
      break;
  }
}

CgalArap::~CgalArap() = default;

void CgalArap::prepare() {
  state_->prepare();
}

void CgalArap::reset() {
  state_->reset();
}

void CgalArap::move(std::span<const Eigen::Affine3d> motions) {
  for (std::size_t h = 0; h < motions.size(); ++h) {
    for (const Index v : state_->region.handles[h]) {
      const Eigen::Vector3d p = motions[h] * state_->rest[v];
      state_->set_target(Vertex(v), {p.x(), p.y(), p.z()});
    }
  }
}

int CgalArap::iterate(int most_iterations, double tolerance) {
  CountingRotations::count = 0;
  state_->deform(static_cast<unsigned>(most_iterations), tolerance);
  return static_cast<int>(CountingRotations::count / state_->region.roi.size());
}

Positions CgalArap::positions() const {
  Positions positions;
  for (const Vertex v : state_->surface.vertices()) {
    const auto& p = state_->surface.point(v);
    positions.emplace_back(p.x(), p.y(), p.z());
  }
  return positions;
}

ArapResult deform_by_cgal_arap(const Mesh& mesh, const EditRegion& region,
                               std::span<const Eigen::Affine3d> motions, ArapVariant variant,
                               int max_iterations, int repeats) {
  CgalArap arap(mesh, region, variant);
  arap.prepare();
  ArapResult result;
  result.frame = measure(repeats, [&] {
    arap.reset();
    arap.move(motions);
    result.iterations = arap.iterate(max_iterations);
  });
  result.positions = arap.positions();
  return result;
}

}  // namespace lapwing::bench
