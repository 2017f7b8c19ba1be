// A head of the package with eyes and a hat that are no part of its surface: bent, it keeps both
// on.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "lapwing/deform/modifiers/attachments.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"
#include "lapwing/region/boundary_loops.h"
#include "support/cap.h"
#include "support/joined_meshes.h"
#include "support/models.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// From each of `points` to the surface.
std::vector<double> distances(std::span<const Vector3d> points, std::span<const Vector3d> surface,
                              const Topology& topology) {
  const ClosestPoint closest(topology.triangles, surface);
  std::vector<double> distances;
  for (const Vector3d& p : points) distances.push_back((closest.find(0, p).position - p).norm());
  return distances;
}

double largest_change(const std::vector<double>& before, const std::vector<double>& after) {
  double largest = 0.0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    largest = std::max(largest, std::abs(after[k] - before[k]));
  }
  return largest;
}

// head.off looks along -x, its neck ends at y = 0, its crown at y = 17; where eyes should be, it
// has two holes.
class HeadWithAHat : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_MODELS(files, "cgal");
    head_ = read_mesh(test::models_folder() / "cgal/meshes/head.off");
    diagonal_ = bounds_of(head_.positions).diagonal();
    for (const BoundaryLoop& loop : boundary_loops(head_.topology().triangles, "head")) {
      if (head_.positions[loop.front()].y() < 5.0) continue;
      rims_.push_back(loop);
      eyes_.push_back(ball_in(loop));
    }
    ASSERT_EQ(eyes_.size(), 2U);
    hat_ = test::cap_of(head_, 13.0, 0.02 * diagonal_, Vector3d(0, 12, 0));
  }

  // A ball that fills the hole from behind.
  Mesh ball_in(const BoundaryLoop& rim) const {
    Vector3d middle = Vector3d::Zero();
    for (const Index v : rim) middle += head_.positions[v] / static_cast<double>(rim.size());
    double radius = 0.0;
    for (const Index v : rim) radius = std::max(radius, (head_.positions[v] - middle).norm());
    Mesh ball = icosphere(3);
    transform(ball, Eigen::Translation3d(middle + Vector3d(0.4 * radius, 0, 0)) *
                        Eigen::Scaling(1.02 * radius));
    return ball;
  }

  // Leans the head: the neck stays, the crown is turned about it.
  static DeformRequest lean(double degrees) {
    DeformRequest request;
    request.roi = {AllVertices{}};
    request.belt = RegionSpec{Box{{-9, -1, -9}, {9, 2, 9}}};
    const SimilarityMove move{.rotate = {{0.5, 0, 1}, degrees}, .pivot = Vector3d(0, 3, 0)};
    request.handles = {{{Box{{-9, 15, -9}, {9, 20, 9}}}, move}};
    return request;
  }

  Positions rim(std::size_t eye, std::span<const Vector3d> head) const {
    Positions points;
    for (const Index v : rims_[eye]) points.push_back(head[v]);
    return points;
  }
  // How much farther from the eye, or closer, some point of its rim is after the edit.
  double change_at_eye(std::size_t eye, std::span<const Vector3d> head,
                       std::span<const Vector3d> ball) const {
    const Topology& topology = eyes_[eye].topology();
    return largest_change(distances(rim(eye, head_.positions), eyes_[eye].positions, topology),
                          distances(rim(eye, head), ball, topology));
  }

  Mesh head_;
  std::vector<BoundaryLoop> rims_;
  std::vector<Mesh> eyes_;
  Mesh hat_;
  double diagonal_ = 0.0;
};

TEST_F(HeadWithAHat, KeepsEyesThatAreLooseComponentsAndAHatThatIsCarried) {
  const Mesh whole = test::joined(test::joined(head_, eyes_[0]), eyes_[1]);
  const Deformed bent = deform(whole, lean(40.0));
  ASSERT_EQ(bent.region.loose.size(), 2U);
  const std::span<const Vector3d> all = bent.mesh.positions;
  const auto head = all.first(head_.vertex_count());
  for (std::size_t e = 0; e < eyes_.size(); ++e) {
    const std::size_t count = eyes_[e].vertex_count();
    const auto ball = all.subspan(head_.vertex_count() + e * count, count);
    EXPECT_LT(change_at_eye(e, head, ball), 0.01 * diagonal_);
    RecordProperty("loose_eye", std::to_string(change_at_eye(e, head, ball) / diagonal_));
  }
  const CarriedPoints hat = carry_points(hat_.positions, whole.positions, bent);
  const double change =
      largest_change(distances(hat_.positions, whole.positions, whole.topology()),
                     distances(hat.positions, bent.mesh.positions, whole.topology()));
  EXPECT_LT(change, 0.01 * diagonal_);
  RecordProperty("hat", std::to_string(change / diagonal_));
}

TEST_F(HeadWithAHat, KeepsEyesThatAreCarriedAsFilesOfTheirOwn) {
  const Deformed bent = deform(head_, lean(40.0));
  const AttachmentDeformer carrier(head_.positions, bent);
  for (std::size_t e = 0; e < eyes_.size(); ++e) {
    const CarriedPoints ball = carrier.carry(eyes_[e].positions);
    const double change = change_at_eye(e, bent.mesh.positions, ball.positions);
    EXPECT_LT(change, 0.01 * diagonal_);
    RecordProperty("carried_eye", std::to_string(change / diagonal_));
  }
}

// No edge of the hat is torn or folded together where what is under it bends.
TEST_F(HeadWithAHat, CarriesAHatWhoseEdgesKeepTheirLengths) {
  const Deformed bent = deform(head_, lean(40.0));
  const CarriedPoints hat = carry_points(hat_.positions, head_.positions, bent);
  const VertexMotion motion = vertex_motion(hat_.positions, hat.positions, hat_.topology());
  const double worst = *std::max_element(motion.stretch.begin(), motion.stretch.end());
  EXPECT_LT(worst, 0.3);
  RecordProperty("hat_stretch", std::to_string(worst));
}

}  // namespace
}  // namespace lapwing
