#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "kernels/mapped_sample.h"
#include "kernels/twins.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::MappedSample;
using test::Sample;
using Transforms = std::vector<Matrix3d>;

/// A FramedSurface that owns its data.
struct Surface {
  FramedSurface view() const { return {positions, normals}; }
  Positions positions;
  std::vector<Vector3d> normals;
};

struct Frames {
  MappedSample mapped;
  Surface source;
  Surface target;
};

Surface surface_of(const Sample& sample, Positions positions) {
  Surface surface{std::move(positions), std::vector<Vector3d>(sample.vertices.size())};
  vertex_normals(surface.positions, sample.topology.triangles, sample.topology.vertex_triangles,
                 sample.vertices, surface.normals);
  return surface;
}

Matrix3d some_turn() {
  return AngleAxisd(2.1, Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
}

// The target is the source, rotated and scaled by 1.7, with a random offset at every vertex.
Frames frames_of(const Sample& sample, unsigned seed, unsigned every_nowhere) {
  Frames frames{
      test::shaken_map(sample, seed, every_nowhere), surface_of(sample, sample.mesh.positions), {}};
  const Positions& rest = sample.mesh.positions;
  const double noise = 0.2 * mean_edge_length(sample.topology.rings, rest);
  std::mt19937 generator(seed + 1);
  std::uniform_real_distribution<double> uniform(-noise, noise);
  Positions positions;
  for (const Vector3d& p : rest) {
    positions.emplace_back(some_turn() * (p - rest.front()) * 1.7 + rest.front());
    for (double& coordinate : positions.back()) coordinate += uniform(generator);
  }
  const Surface target = surface_of(sample, std::move(positions));
  frames.target = {frames.mapped.own(target.positions), frames.mapped.own(target.normals)};
  return frames;
}

class RotateFrames : public test::KernelTest {
 protected:
  Transforms rotate(const MappedSample& mapped, const Surface& source, const Surface& target) {
    Transforms transforms(mapped.target.row_count(), Matrix3d::Constant(7.0));
    kernels->rotate_frames(mapped.rings(), source.view(), target.view(), transforms);
    return transforms;
  }
  Transforms rotate(const Frames& frames) {
    return rotate(frames.mapped, frames.source, frames.target);
  }
  double tolerance() const { return GetParam().tolerance; }
  void expect_rotation(const Matrix3d& R, const std::string& name) {
    EXPECT_LE((R * R.transpose() - Matrix3d::Identity()).norm(), tolerance()) << name;
    EXPECT_NEAR(R.determinant(), 1.0, tolerance()) << name;
  }
};

// Returns R, where T = s R.
Matrix3d turn_in(const Matrix3d& T) {
  return T / std::cbrt(T.determinant());
}

Vector3d source_normal(const Frames& frames, std::size_t row) {
  return frames.mapped.points[row].of(std::span<const Vector3d>(frames.source.normals));
}

struct EdgePair {
  Vector3d a;  // edge of the mapped ring
  Vector3d b;  // edge of the target's ring
};
std::vector<EdgePair> edges_of(const Frames& frames, std::size_t row) {
  const auto& [mapped, source, target] = frames;
  const std::span<const Vector3d> places = source.positions;
  std::vector<EdgePair> edges;
  for (std::size_t e = mapped.target.starts[row]; e < mapped.target.starts[row + 1]; ++e) {
    const Index j = mapped.target.neighbours[e];
    if (mapped.points[j].is_nowhere()) continue;
    edges.push_back({mapped.points[j].of(places) - mapped.points[row].of(places),
                     target.positions[j] - target.positions[row]});
  }
  return edges;
}

double projected_error(const std::vector<EdgePair>& edges, const Matrix3d& R, const Vector3d& n) {
  double sum = 0.0;
  for (const auto& [a, b] : edges) sum += (R * a - b).cross(n).squaredNorm();
  return sum;
}

// Returns one row whose neighbours lie at `a` on the source and at `b` on the target.
Frames ring_frames(const std::vector<EdgePair>& edges, const Vector3d& source_normal,
                   const Vector3d& target_normal) {
  Frames frames;
  frames.mapped = test::one_ring(std::vector<bool>(edges.size(), true));
  const Vector3d source_center(3.0, -2.0, 5.0);
  const Vector3d target_center(-7.0, 4.0, 1.0);
  frames.source.positions.push_back(source_center);
  frames.target.positions.push_back(target_center);
  for (const auto& [a, b] : edges) {
    frames.source.positions.push_back(source_center + a);
    frames.target.positions.push_back(target_center + b);
  }
  frames.source.normals.assign(edges.size() + 1, source_normal);
  frames.target.normals.assign(edges.size() + 1, target_normal);
  return frames;
}

const Vector3d kSomeNormal = Vector3d(0.3, -0.8, 0.4).normalized();
const Vector3d kOtherNormal = Vector3d(-0.5, 0.1, -0.9).normalized();

TEST_P(RotateFrames, StandStillOnASurfaceMappedOntoItself) {
  for (const Sample& sample : test::awkward_meshes()) {
    const MappedSample mapped = test::identity_map(sample);
    const Surface surface = surface_of(sample, sample.mesh.positions);
    for (const Matrix3d& T : rotate(mapped, surface, surface)) {
      EXPECT_LE((T - Matrix3d::Identity()).norm(), tolerance()) << sample.name;
    }
  }
}

TEST_P(RotateFrames, AreRotationsThatCarryNormalsAndTurnEdgesBest) {
  for (const Sample& sample : test::awkward_meshes()) {
    for (const unsigned every_nowhere : {0U, 4U}) {
      const Frames frames = frames_of(sample, 41, every_nowhere);
      const Transforms transforms = rotate(frames);
      for (std::size_t r = 0; r < transforms.size(); ++r) {
        const std::string name = sample.name + " row " + std::to_string(r);
        const Matrix3d R = turn_in(transforms[r]);
        expect_rotation(R, name);
        const Vector3d from = source_normal(frames, r);
        const Vector3d to = frames.target.normals[r];
        if (from.norm() < 1e-3 || to.isZero()) continue;
        EXPECT_LE((R * from.normalized() - to).norm(), tolerance() / from.norm()) << name;
        const auto edges = edges_of(frames, r);
        double spread = 0.0;
        for (const auto& [a, b] : edges) spread += a.squaredNorm() + b.squaredNorm();
        for (int degrees = 1; degrees < 360; degrees += degrees < 10 ? 1 : 10) {
          const AngleAxisd turn(degrees * std::numbers::pi / 180.0, to);
          EXPECT_LE(projected_error(edges, R, to),
                    projected_error(edges, turn * R, to) + 10.0 * tolerance() * spread)
              << name << " turned by " << degrees;
        }
      }
    }
  }
}

TEST_P(RotateFrames, TurnAndScaleWithTheSourceAndTheTarget) {
  const Sample sample("rough sphere", test::rough_sphere(2, 0.1, 42));
  const Frames frames = frames_of(sample, 43, 6);
  const Matrix3d S = AngleAxisd(-1.3, Vector3d(0.2, 0.9, 1.0).normalized()).toRotationMatrix();
  const Matrix3d U = AngleAxisd(2.9, Vector3d(1.0, 0.1, -0.7).normalized()).toRotationMatrix();
  const auto moved = [](Surface surface, const Matrix3d& turn, double size, const Vector3d& by) {
    for (Vector3d& p : surface.positions) p = size * (turn * p) + by;
    for (Vector3d& n : surface.normals) n = turn * n;
    return surface;
  };
  const Surface source = moved(frames.source, S, 0.25, Vector3d(1.0, 2.0, -3.0));
  const Surface target = moved(frames.target, U, 3.0, Vector3d(-4.0, 0.5, 6.0));
  constexpr double kGrowth = 12.0;
  const Transforms before = rotate(frames);
  const Transforms after = rotate(frames.mapped, source, target);
  for (std::size_t r = 0; r < before.size(); ++r) {
    if (frames.mapped.points[r].is_nowhere()) continue;
    EXPECT_LE((after[r] - kGrowth * U * before[r] * S.transpose()).norm(),
              100.0 * tolerance() * after[r].norm())
        << "row " << r;
  }
}

TEST_P(RotateFrames, AgreeWithTheCpuTwinFarFromTheOrigin) {
  Sample sample("rough sphere", test::rough_sphere(2, 0.1, 44));
  for (Vector3d& p : sample.mesh.positions) p += Vector3d(1e4, -1e4, 2e4);
  const Frames frames = frames_of(sample, 45, 6);
  Transforms expected(frames.mapped.target.row_count());
  CpuKernels().rotate_frames(frames.mapped.rings(), frames.source.view(), frames.target.view(),
                             expected);
  const Transforms transforms = rotate(frames);
  for (std::size_t r = 0; r < expected.size(); ++r) {
    EXPECT_LE((transforms[r] - expected[r]).norm(), 20.0 * tolerance() * expected[r].norm())
        << "row " << r;
  }
}

// The frame of section 5.1 consists of the normal, the edge projected onto the tangent plane, and
// their cross product.
TEST_P(RotateFrames, AreThoseOfThePaperForOneMappedEdge) {
  const auto frame = [](const Vector3d& normal, const Vector3d& edge) {
    Matrix3d F;
    F.col(0) = normal;
    F.col(1) = (edge - edge.dot(normal) * normal).normalized();
    F.col(2) = F.col(0).cross(F.col(1));
    return F;
  };
  const Vector3d a(0.4, 0.3, 0.2);
  const Vector3d b(-0.1, 0.7, 0.3);
  Frames frames =
      ring_frames({{Vector3d(9, 9, 9), Vector3d(-9, 8, 7)}, {a, b}}, kSomeNormal, kOtherNormal);
  frames.mapped.points[1] = SurfacePoint::nowhere();
  const Matrix3d expected = frame(kOtherNormal, b) * frame(kSomeNormal, a).transpose();
  EXPECT_LE((turn_in(rotate(frames)[0]) - expected).norm(), 10.0 * tolerance());
}

TEST_P(RotateFrames, CarryANormalToItsOpposite) {
  const EdgePair along{kSomeNormal.cross(Vector3d::UnitX()), kSomeNormal.cross(Vector3d::UnitZ())};
  for (const Vector3d& n : {kSomeNormal, kOtherNormal, Vector3d(0, 0, 1), Vector3d(0, 0, -1)}) {
    for (const auto& edges : {std::vector<EdgePair>{}, std::vector<EdgePair>{along}}) {
      const Frames frames = ring_frames(edges, n, -n);
      const Matrix3d R = turn_in(rotate(frames)[0]);
      expect_rotation(R, "antiparallel");
      EXPECT_LE((R * n + n).norm(), tolerance());
      if (edges.empty()) continue;
      const Vector3d there = n.cross(R * along.a).normalized();
      EXPECT_LE((there - n.cross(along.b).normalized()).norm(), 10.0 * tolerance());
    }
  }
}

TEST_P(RotateFrames, AreTheSmallestTurnWhereEdgesTellNothing) {
  const Matrix3d expected = Eigen::AngleAxisd(std::acos(kSomeNormal.dot(kOtherNormal)),
                                              kSomeNormal.cross(kOtherNormal).normalized())
                                .toRotationMatrix();
  const Vector3d across = kSomeNormal.unitOrthogonal();
  const Vector3d target_across = kOtherNormal.unitOrthogonal();
  const std::vector<std::vector<EdgePair>> silent{
      {},
      {{kSomeNormal, target_across}, {-2.0 * kSomeNormal, kOtherNormal}},
      {{across, Vector3d::Zero()}, {Vector3d::Zero(), target_across}},
      {{across, target_across}, {-across, target_across}}};
  for (std::size_t k = 0; k < silent.size(); ++k) {
    const Frames frames = ring_frames(silent[k], kSomeNormal, kOtherNormal);
    EXPECT_LE((turn_in(rotate(frames)[0]) - expected).norm(), 10.0 * tolerance()) << "ring " << k;
  }
}

TEST_P(RotateFrames, WithoutANormalTurnTheWholeEdgesBest) {
  std::vector<EdgePair> edges;
  for (const Vector3d& a : {Vector3d(1.0, 0.1, 0.2), Vector3d(-0.3, 0.8, 0.1),
                            Vector3d(-0.5, -0.7, 0.4), Vector3d(0.2, -0.9, -0.3)}) {
    edges.push_back({a, 1.5 * some_turn() * a});
  }
  const Vector3d none = Vector3d::Zero();
  for (const auto& [from, to] :
       {EdgePair{none, kSomeNormal}, EdgePair{kSomeNormal, none}, EdgePair{none, none}}) {
    EXPECT_LE((rotate(ring_frames(edges, from, to))[0] - 1.5 * some_turn()).norm(),
              10.0 * tolerance());
    EXPECT_EQ(rotate(ring_frames({}, from, to))[0], Matrix3d::Identity());
  }
}

TEST_P(RotateFrames, ScaleByTheRatioOfEdgeLengths) {
  const Sample sample("rough sphere", test::rough_sphere(1, 0.1, 46));
  const Frames frames = frames_of(sample, 47, 6);
  const Transforms transforms = rotate(frames);
  for (std::size_t r = 0; r < transforms.size(); ++r) {
    if (frames.mapped.points[r].is_nowhere()) continue;
    double from = 0.0;
    double to = 0.0;
    for (const auto& [a, b] : edges_of(frames, r)) {
      from += a.squaredNorm();
      to += b.squaredNorm();
    }
    const double ratio = from > 0.0 ? std::sqrt(to / from) : 1.0;
    EXPECT_NEAR(std::cbrt(transforms[r].determinant()), ratio, 10.0 * tolerance() * ratio)
        << "row " << r;
  }
}

TEST_P(RotateFrames, AreNotScaledByARingWithoutExtent) {
  const Vector3d b = kOtherNormal.unitOrthogonal();
  for (const double extent : {0.0, 1e-160, 1e-21}) {
    const Vector3d a = extent * kSomeNormal.unitOrthogonal();
    Frames frames = ring_frames({{a, b}, {-a, -b}}, kSomeNormal, kOtherNormal);
    frames.source.positions = {Vector3d::Zero(), a, -a};
    expect_rotation(rotate(frames)[0], "ring without extent");
  }
}

TEST_P(RotateFrames, AreTheIdentityWhereARowLiesNowhere) {
  Frames frames = ring_frames({{Vector3d::UnitX(), Vector3d::UnitY()}}, kSomeNormal, kOtherNormal);
  frames.mapped.points[0] = SurfacePoint::nowhere();
  EXPECT_EQ(rotate(frames)[0], Matrix3d::Identity());
  frames.mapped.points[1] = SurfacePoint::nowhere();
  frames.source = {};
  EXPECT_EQ(rotate(frames)[0], Matrix3d::Identity());
}

// The mesh has more one-rings than one submission to a device can process.
TEST_P(RotateFrames, OfManyRingsAreAsThoseOfFew) {
  const Sample sample("sphere", test::rough_sphere(6, 1e-3, 48));
  const Frames frames = frames_of(sample, 49, 100);
  ASSERT_GT(frames.mapped.target.row_count() + frames.mapped.target.neighbours.size(),
            std::size_t{1} << 18U)
      << "else this test is about one submission";
  const Transforms transforms = rotate(frames);
  for (std::size_t r = 0; r < transforms.size(); ++r) {
    if (frames.mapped.points[r].is_nowhere()) continue;
    const Vector3d carried = turn_in(transforms[r]) * source_normal(frames, r).normalized();
    EXPECT_LE((carried - frames.target.normals[r]).norm(), 10.0 * tolerance()) << "row " << r;
  }
}

TEST_P(RotateFrames, RepeatBitForBit) {
  const Sample sample("rough sphere", test::rough_sphere(3, 0.1, 50));
  const Frames frames = frames_of(sample, 51, 9);
  EXPECT_EQ(rotate(frames), rotate(frames));
}

LAPWING_ON_ALL_TWINS(RotateFrames);

}  // namespace
}  // namespace lapwing
