#include <gtest/gtest.h>

#include "coating/coating_scenes.h"
#include "lapwing/coating/coating.h"
#include "lapwing/coating/fairing.h"
#include "lapwing/coating/ring_operators.h"
#include "lapwing/mesh/subdivide.h"
#include "support/bent_tube.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;

constexpr double kItsDetail = 0.5;
constexpr auto kBothSchemes = {LaplacianWeights::cotangent, LaplacianWeights::uniform};

// A patch that is laid on its own coating.
struct OnItself {
  OnItself(const Mesh& mesh, const VertexSet& region, LaplacianWeights scheme)
      : surface(mesh, region),
        weights(scheme),
        coating(peel_patch(surface.patch, mesh.positions, surface.topology, kItsDetail, scheme,
                           kernels)),
        rings(region_rings(
            surface.topology, mesh.positions,
            {laplacian_weights(surface.topology, mesh.positions, scheme, surface.patch.vertices),
             {},
             {}},
            surface.patch.vertices, {})) {
    for (const Index v : rings.vertices) {
      const Index own = surface.patch.own_number(v);
      points.push_back(own == kNoIndex ? SurfacePoint::nowhere() : SurfacePoint::at_vertex(own));
    }
  }
  std::vector<Vector3d> sampled(MappedSampling sampling) {
    return sample_coating({rings, points}, coating, sampling, surface.topology, weights, kernels);
  }

  CpuKernels kernels;
  PatchedMesh surface;
  LaplacianWeights weights;
  Coating coating;
  RegionRings rings;
  std::vector<SurfacePoint> points;
};

VertexSet middle_of(const Mesh& mesh) {
  return within(mesh, Vector3d(0.5, 0.5, 0.0), 0.3);
}

// Far from the origin, so that it shows where what lies nowhere is taken for a place.
TEST(SampleCoating, InterpolatedOnASurfaceItselfIsThatOfItsRings) {
  const Mesh mesh = uneven_relief(24, 4.0, 0.04, 1);
  const Mesh far = transformed(mesh, Eigen::Affine3d(Eigen::Translation3d(100.0, -200.0, 300.0)));
  for (const VertexSet& region : {every_vertex(mesh), middle_of(mesh)}) {
    for (const auto scheme : kBothSchemes) {
      OnItself itself(far, region, scheme);
      const auto rings = itself.sampled(MappedSampling::one_ring);
      EXPECT_LT(largest_distance(itself.sampled(MappedSampling::linear), rings), 1e-10);
    }
  }
}

// All rings in one triangle of the source, in which a displacement that is linear is not curved.
TEST(SampleCoating, InterpolatedBetweenVerticesIsCurvedAsTheSourceIsThere) {
  const PatchedMesh source(uneven_relief(24, 4.0, 0.02, 1));
  const Coating coating = peel_cotangent(source, kItsDetail);
  const Triangle& triangle = source.patch.triangles[600];
  Mesh target = grid(6, 6);
  std::vector<SurfacePoint> points;
  for (Vector3d& p : target.positions) {
    points.push_back({triangle, {0.2 + 0.3 * p.x(), 0.2 + 0.3 * p.y(), 0.0}});
    points.back().weights[2] = 1.0 - points.back().weights[0] - points.back().weights[1];
    p = points.back().of<Vector3d>(coating.smooth);
  }
  const Topology& topology = target.topology();
  const auto weights = laplacian_weights(topology, target.positions, LaplacianWeights::cotangent,
                                         every_vertex(target));
  const RegionRings rings =
      region_rings(topology, target.positions, {weights, {}, {}}, every_vertex(target), {});
  CpuKernels kernels;
  const auto sampled = [&](MappedSampling sampling) {
    return sample_coating({rings, points}, coating, sampling, topology, LaplacianWeights::cotangent,
                          kernels);
  };
  const auto faceted = sampled(MappedSampling::one_ring);
  const auto curved = sampled(MappedSampling::linear);
  const auto squares = squared_rings(topology.rings, weights, target.positions, rings.vertices);
  constexpr Index kInner = 3 * 7 + 3;
  const Vector3d expected = 0.25 * squares[kInner] * points[kInner].of<Vector3d>(coating.curvature);
  EXPECT_LT(faceted[kInner].norm(), 1e-12);
  EXPECT_GT(expected.norm(), 1e-6);
  EXPECT_LT((curved[kInner] - expected).norm(), 1e-12);
}

// How far from itself, in heights of its relief, a surface comes out when its own coating comes to
// it in place of its detail.
double error_on_itself(const Mesh& mesh, const VertexSet& region, LaplacianWeights scheme,
                       double transition) {
  OnItself itself(mesh, region, scheme);
  const PatchedMesh& surface = itself.surface;
  const Positions smooth = smooth_around(surface.patch.vertices, kItsDetail, mesh.positions,
                                         surface.topology, scheme, "smooth_target");
  CoaterOptions options;
  options.weights = scheme;
  options.hold_length = kItsDetail;
  options.transition.width = transition;
  Coater coater({mesh.positions, smooth}, surface.topology, surface.patch, options, itself.kernels);
  coater.take(itself.coating, each_to_itself(surface.patch), {MappedSampling::linear, {}});
  double height = 0.0;
  for (const Vector3d& d : itself.coating.displacement) height = std::max(height, d.norm());
  return largest_distance(coater.coat(1.0), mesh.positions) / height;
}

TEST(Coat, GivesASteepUnevenSurfaceItselfBackLinearly) {
  const Mesh mesh = uneven_relief(24, 4.0, 0.04, 1);
  for (const VertexSet& region : {every_vertex(mesh), middle_of(mesh)}) {
    for (const auto scheme : kBothSchemes) {
      for (const double transition : {0.0, kItsDetail}) {
        EXPECT_LT(error_on_itself(mesh, region, scheme, transition), 1e-8);
      }
    }
  }
}

TEST(Coat, GivesAPotatoItselfBackLinearly) {
  Mesh mesh = icosphere(4);
  for (Vector3d& p : mesh.positions)
    p *= 1.0 + 0.05 * std::sin(9.0 * p.x()) * std::sin(11.0 * p.y());
  const VertexSet cap = within(mesh, Vector3d(0.2, 0.3, 1.0), 0.9);
  EXPECT_LT(error_on_itself(mesh, cap, LaplacianWeights::cotangent, 0.0), 1e-8);
}

}  // namespace
}  // namespace lapwing::test
