#pragma once

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "run/transplant_runs.h"
#include "viewer_window/window_test.h"

namespace lapwing {

/// A ball, and a finger among the parts.
class Transplanting : public test::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    mesh_ = icosphere(5);
    write_mesh(mesh_, ball());
    std::filesystem::create_directories(person_->parts());
    write_mesh(test::finger(24, 20, 0.2, 0.6), person_->parts() / "finger.ply");
    open(ball());
    person_->look_from(View::front, mesh_.positions);
  }

  // Until the part shows there: it is read beside the window.
  bool carries_to(const Eigen::Vector2d& pixel) {
    const Image before = desktop_->settled_picture();
    return test::eventually(90.0, [&] {
      person_->move_to(pixel + Eigen::Vector2d(2.0, 0.0));
      person_->move_to(pixel);
      return test::mean_difference(desktop_->picture(), before) > 0.5;
    });
  }
  Eigen::Vector3d part_place() const {
    const auto step = std::get<TransplantStep>(person_->draft().value().steps.at(0));
    return to_affine(std::get<Move>(step.place), Eigen::Vector3d::Zero()).translation();
  }
  std::filesystem::path ball() const { return folder_ / "ball.ply"; }

  Mesh mesh_;
};

}  // namespace lapwing
