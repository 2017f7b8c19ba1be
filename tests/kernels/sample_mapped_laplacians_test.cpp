#include <algorithm>

#include <gtest/gtest.h>

#include "kernels/mapped_sample.h"
#include "kernels/twins.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using test::MappedSample;
using test::Sample;

class SampleMappedLaplacians : public test::KernelTest {
 protected:
  Positions sample_on(const MappedSample& mapped, MappedSampling sampling,
                      std::span<const Vector3d> source) {
    Positions laplacians(mapped.target.row_count(), Vector3d::Constant(7.0));
    kernels->sample_mapped_laplacians(mapped.rings(), sampling, source, laplacians);
    return laplacians;
  }
  double tolerance() const { return GetParam().tolerance; }
};

Vector3d value_at(const SurfacePoint& point, std::span<const Vector3d> f) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    if (point.weights[c] != 0.0) sum += point.weights[c] * f[point.corners[c]];
  }
  return sum;
}

// Evaluates the definition for the field `rest` + `origin`. Keeps the precision of `rest` even if
// `origin` is large.
Vector3d expected_laplacian(const MappedSample& mapped, std::size_t row,
                            std::span<const Vector3d> rest, const Vector3d& origin) {
  const RegionRings& rings = mapped.target;
  const SurfacePoint& here = mapped.points[row];
  Vector3d sum = Vector3d::Zero();
  if (here.is_nowhere()) return sum;
  for (std::size_t e = rings.starts[row]; e < rings.starts[row + 1]; ++e) {
    const SurfacePoint& there = mapped.points[rings.neighbours[e]];
    const Vector3d other = there.is_nowhere() ? Vector3d(-origin) : value_at(there, rest);
    sum += rings.weights[e] * (value_at(here, rest) - other);
  }
  return sum;
}

// Returns the largest difference between the values that row `row` reads.
double extent_of(const MappedSample& mapped, std::size_t row, std::span<const Vector3d> f) {
  const SurfacePoint& here = mapped.points[row];
  if (here.is_nowhere()) return 0.0;
  double extent = 0.0;
  const auto add = [&](const SurfacePoint& point) {
    for (const Index corner : point.corners) {
      extent = std::max(extent, (f[corner] - f[here.corners[0]]).norm());
    }
  };
  add(here);
  for (std::size_t e = mapped.target.starts[row]; e < mapped.target.starts[row + 1]; ++e) {
    const SurfacePoint& there = mapped.points[mapped.target.neighbours[e]];
    add(there.is_nowhere() ? here : there);
    if (there.is_nowhere()) extent = std::max(extent, f[here.corners[0]].norm());
  }
  return extent;
}

void expect_laplacians(const MappedSample& mapped, std::span<const Vector3d> f,
                       const Positions& laplacians, double tolerance, const std::string& name) {
  Positions rest;
  for (const Vector3d& value : f) rest.push_back(value - f[0]);
  for (std::size_t r = 0; r < laplacians.size(); ++r) {
    EXPECT_LE((laplacians[r] - expected_laplacian(mapped, r, rest, f[0])).norm(),
              tolerance * extent_of(mapped, r, f))
        << name << " row " << r;
  }
}

TEST_P(SampleMappedLaplacians, OfAMappedRingAreDifferencesOfItsValues) {
  for (const Sample& sample : test::awkward_meshes()) {
    for (const unsigned every_nowhere : {0U, 5U}) {
      const MappedSample mapped = test::shaken_map(sample, 21, every_nowhere);
      const auto laplacians = sample_on(mapped, MappedSampling::one_ring, sample.mesh.positions);
      expect_laplacians(mapped, sample.mesh.positions, laplacians, tolerance(), sample.name);
    }
  }
}

TEST_P(SampleMappedLaplacians, OfASurfaceMappedOntoItselfAreItsOwn) {
  for (const Sample& sample : test::awkward_meshes()) {
    const MappedSample mapped = test::identity_map(sample);
    Positions own(sample.vertices.size());
    kernels->sample_laplacians(sample.problem(), own);
    const auto laplacians = sample_on(mapped, MappedSampling::one_ring, sample.mesh.positions);
    for (std::size_t i = 0; i < own.size(); ++i) {
      EXPECT_LE((laplacians[i] - own[i]).norm(),
                tolerance() * extent_of(mapped, i, sample.mesh.positions))
          << sample.name << " vertex " << i;
    }
  }
}

TEST_P(SampleMappedLaplacians, OfAConstantFieldAreZero) {
  for (const Sample& sample : test::awkward_meshes()) {
    const MappedSample mapped = test::shaken_map(sample, 24, 0);
    const Positions field(sample.vertices.size(), Vector3d(1e4, -3e3, 0.1));
    for (const Vector3d& delta : sample_on(mapped, MappedSampling::one_ring, field)) {
      EXPECT_EQ(delta, Vector3d::Zero()) << sample.name;
    }
  }
}

TEST_P(SampleMappedLaplacians, LinearOnesAreInterpolatedWithAndWithoutRings) {
  for (const Sample& sample : test::awkward_meshes()) {
    const MappedSample mapped = test::shaken_map(sample, 26, 5);
    const auto laplacians = sample_on(mapped, MappedSampling::linear, sample.mesh.positions);
    for (std::size_t r = 0; r < laplacians.size(); ++r) {
      const Vector3d expected = value_at(mapped.points[r], sample.mesh.positions);
      EXPECT_LE((laplacians[r] - expected).norm(), tolerance() * expected.norm())
          << sample.name << " row " << r;
    }
  }
}

TEST_P(SampleMappedLaplacians, TakeANeighbourThatLiesNowhereForZero) {
  const Positions field{{2.0, 0.0, -4.0}, {1.0, 1.0, 1.0}, {9.0, 9.0, 9.0}};
  const MappedSample mapped = test::one_ring({true, false});
  const auto laplacians = sample_on(mapped, MappedSampling::one_ring, field);
  EXPECT_LE((laplacians[0] - Vector3d(1.5, -0.5, -4.5)).norm(), tolerance());
}

TEST_P(SampleMappedLaplacians, AreZeroWhereNothingIsKnown) {
  MappedSample nowhere = test::one_ring({true, true});
  nowhere.points[0] = SurfacePoint::nowhere();
  const Positions field(3, Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(sample_on(nowhere, MappedSampling::one_ring, field)[0], Vector3d::Zero());
  EXPECT_EQ(sample_on(nowhere, MappedSampling::linear, field)[0], Vector3d::Zero());
  EXPECT_EQ(sample_on(test::one_ring({}), MappedSampling::one_ring, field)[0], Vector3d::Zero());
  nowhere.points.assign(3, SurfacePoint::nowhere());
  EXPECT_EQ(sample_on(nowhere, MappedSampling::one_ring, {})[0], Vector3d::Zero());
}

// The mesh has more one-rings than one submission to a device can process.
TEST_P(SampleMappedLaplacians, OfManyRingsAreAsThoseOfFew) {
  const Sample sample("sphere", test::rough_sphere(6, 1e-3, 29));
  const MappedSample mapped = test::shaken_map(sample, 30, 100);
  ASSERT_GT(mapped.target.row_count() + mapped.target.neighbours.size(), std::size_t{1} << 18U)
      << "else this test is about one submission";
  const auto laplacians = sample_on(mapped, MappedSampling::one_ring, sample.mesh.positions);
  expect_laplacians(mapped, sample.mesh.positions, laplacians, tolerance(), sample.name);
}

TEST_P(SampleMappedLaplacians, RepeatBitForBit) {
  const Sample sample("rough sphere", test::rough_sphere(3, 0.2, 31));
  const MappedSample mapped = test::shaken_map(sample, 32, 9);
  EXPECT_EQ(sample_on(mapped, MappedSampling::one_ring, sample.mesh.positions),
            sample_on(mapped, MappedSampling::one_ring, sample.mesh.positions));
}

LAPWING_ON_ALL_TWINS(SampleMappedLaplacians);

}  // namespace
}  // namespace lapwing
