// Columns for the handles alone that a drag moves.
#include <array>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/drag.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/deform/drag_session.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "support/largest_distance.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using test::largest_distance;

// A cylinder held at its foot, with three handles: a single vertex, a ring of it, and its top.
class CylinderOfThreeHandles : public ::testing::Test {
 protected:
  CylinderOfThreeHandles() {
    region_ = test::ends_of_cylinder(mesh_);
    const VertexSet top = region_.handles[0];
    region_.handles = {{}, {}, top};
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const double z = mesh_.positions[v].z();
      if (z > 3.9 && z < 4.1) region_.handles[1].push_back(v);
      if (region_.handles[0].empty() && z > 2.0) region_.handles[0].push_back(v);
    }
    solver_ = std::make_shared<const DeformSolver>(mesh_.positions, topology_, region_,
                                                   DeformOptions(), kernels_);
  }

  static std::vector<Affine3d> motions(double first, double second, double third) {
    return {Affine3d(Eigen::Translation3d(first, 0, 0)),
            test::turn_and_move(second, Vector3d::UnitZ(), Vector3d::Zero()),
            Affine3d(Eigen::Translation3d(0, third, 0))};
  }
  Positions dragged(const std::shared_ptr<const DragResponse>& response,
                    const std::shared_ptr<const DragState>& pose,
                    const std::vector<Affine3d>& to) const {
    Positions positions = mesh_.positions;
    Drag(response, pose).move(to, positions);
    return positions;
  }
  // The settled surface at these motions.
  std::shared_ptr<const DragState> pose_at(const std::vector<Affine3d>& at) const {
    DragSession drag(solver_);
    return std::make_shared<const DragState>(drag.step(at));
  }

  Mesh mesh_ = test::rippled_cylinder(16, 31);
  Topology topology_ = mesh_.topology();
  EditRegion region_;
  CpuKernels kernels_;
  std::shared_ptr<const DeformSolver> solver_;
};

TEST_F(CylinderOfThreeHandles, ColumnsOfSomeAreThoseAmongAll) {
  const auto all = solver_->response();
  const std::array<std::size_t, 3> some{2, 0, 2};
  const auto response = solver_->response_of(some);
  EXPECT_EQ(response->handles(), (std::vector<std::size_t>{0, 2}));
  const std::size_t of_handle = all->columns().numbers.size() / 3;
  const auto numbers = response->columns().numbers;
  ASSERT_EQ(numbers.size(), 2 * of_handle);
  for (std::size_t k = 0; k < of_handle; ++k) {
    ASSERT_EQ(numbers[k], all->columns().numbers[k]);
    ASSERT_EQ(numbers[of_handle + k], all->columns().numbers[2 * of_handle + k]);
  }
}

TEST_F(CylinderOfThreeHandles, ColumnsOfAPreviewAreThoseAmongAll) {
  PreparedRegion prepared(topology_);
  const DragPreview all(prepared, mesh_.positions, region_, {});
  const std::array<std::size_t, 1> last{2};
  const DragPreview some(prepared, mesh_.positions, region_, {}, last);
  const auto to = motions(0, 0, 0.7);
  EXPECT_EQ(dragged(some.response(), nullptr, to), dragged(all.response(), nullptr, to));
  EXPECT_EQ(dragged(all.response_of(last), nullptr, to), dragged(all.response(), nullptr, to));
}

TEST_F(CylinderOfThreeHandles, DragOfOneGoesOnFromWhereTheOthersHaveMoved) {
  const auto pose = pose_at(motions(0.2, 20.0, 0.0));
  const auto to = motions(0.2, 20.0, 0.5);
  const std::array<std::size_t, 1> last{2};
  const Positions by_all = dragged(solver_->response(), pose, to);
  const Positions by_one = dragged(solver_->response_of(last), pose, to);
  EXPECT_LT(largest_distance(by_one, by_all), 1e-12);
  EXPECT_GT(largest_distance(by_one, dragged(solver_->response(), pose, motions(0.2, 20.0, 0.0))),
            0.3);
}

TEST_F(CylinderOfThreeHandles, MotionsMustBeThoseOfAllHandles) {
  const std::array<std::size_t, 1> first{0};
  Drag drag(solver_->response_of(first));
  EXPECT_THROW(drag.parameters(std::vector<Affine3d>(1, Affine3d::Identity())), InputError);
}

}  // namespace
}  // namespace lapwing
