#pragma once

#include <algorithm>
#include <functional>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/atomic_file.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/run/run_recipe.h"
#include "state/journal.h"
#include "support/gpu.h"
#include "support/keep_picture.h"
#include "support/largest_distance.h"
#include "support/models.h"
#include "tools/disk_tool.h"
#include "viewer_state/sheet_edit.h"
#include "viewer_window/window_test.h"

namespace lapwing {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;
using viewer::Draft;
using viewer::GizmoMode;
using viewer::GizmoPart;

template <typename Form>
bool is(const RegionSpec& region) {
  return std::holds_alternative<Form>(region.form);
}

// Mean difference of pictures that show the same: what moves is drawn without antialiasing.
inline constexpr double kSamePicture = 0.25;

class Editing : public test::WindowTest {
 protected:
  // A tube along z, seen from the right: z goes to the left.
  void open_tube() {
    write_mesh(rippled_cylinder(24, 41), tube());
    mesh_ = read_mesh(tube());
    open(tube());
    person_->look_from(View::right, mesh_.positions);
  }

  // The scan of `libcgal-demo`, seen from the front.
  void open_armadillo() {
    const fs::path armadillo = folder_ / "armadillo.off";
    fs::copy_file(test::models_folder() / "cgal" / "meshes" / "armadillo.off", armadillo);
    mesh_ = read_mesh(armadillo);
    open(armadillo);
    person_->look_from(View::front, mesh_.positions);
  }

  // ROI and handle by brushes of the box tool: from z = 1 on, and from z = 5.4 on.
  void choose_parts() {
    person_->keys("b i");
    box_from(1.0);
    ASSERT_TRUE(
        person_->eventually_is([](const Draft& d) { return is<ListedVertices>(d.open.roi); }));
    person_->keys("h");
    box_from(5.4);
    ASSERT_TRUE(has_handles(1));
    person_->keys("m");
  }

  void box_from(double z) { person_->drag_between({0.5, -0.7, z}, {0.5, 0.7, 6.2}); }

  // Moves the handle in the plane of the view by a typed number.
  void move_by(const std::string& number) {
    person_->keys("g");
    person_->type(number);
    person_->keys("Return");
  }

  void bend_tube() {
    open_tube();
    choose_parts();
    move_by("0.5");
    ASSERT_TRUE(settles());
  }

  // Until the result of what the person did last is there.
  bool settles() {
    return person_->eventually_is([](const Draft& d) { return d.settled; });
  }

  viewer::Gizmo gizmo(GizmoMode mode) const {
    const Draft draft = person_->draft().value();
    const VertexSet vertices = resolve(draft.open.handles.at(0).region, mesh_);
    Vector3d centroid = Vector3d::Zero();
    for (const Index v : vertices) centroid += mesh_.positions[v];
    centroid /= static_cast<double>(vertices.size());
    return {mode, to_affine(draft.open.handles[0].move, centroid) * centroid};
  }

  // Takes a part of the gizmo and drags it by so many pixels.
  void drag_part(GizmoMode mode, GizmoPart part, const Vector2d& by) {
    const Vector2d from = test::middle_of(gizmo(mode), part, person_->projection());
    person_->drag({from, from + 0.3 * by, from + 0.7 * by, from + by});
  }

  // The picture where the tube is between belt and handle, beside the gizmo.
  Image free_part() const {
    const Image screen = desktop_->settled_picture();
    const auto corner = person_->pixel_of({0.5, 1.5, 4.4}).cast<std::uint32_t>().eval();
    const auto opposite = person_->pixel_of({0.5, -0.7, 1.0}).cast<std::uint32_t>().eval();
    return test::part_of(screen, corner.x(), corner.y(), opposite.x() - corner.x(),
                         opposite.y() - corner.y());
  }

  SimilarityMove move() const {
    return std::get<SimilarityMove>(person_->draft().value().open.handles.at(0).move);
  }

  fs::path tube() const { return folder_ / "tube.obj"; }

  Mesh mesh_;
};

}  // namespace lapwing
