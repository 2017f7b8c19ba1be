// Whole sessions of a person, from the mesh to what is saved, each killed in every stage: what was
// done is there again, and the person goes on.
#include "lapwing/doctor/check.h"
#include "lapwing/run/run_recipe.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "viewer_window/doctor_window.h"
#include "viewer_window/editing_window.h"
#include "viewer_window/layers_window.h"
#include "viewer_window/transplant_window.h"

namespace lapwing {
namespace {

// Any of the windows, in which the viewer is killed and takes up what it was at.
template <typename Window>
class Session : public Window {
 protected:
  // As the viewer shows it then: `view` of `positions`.
  void crash_and_restore(View view, const Positions& positions) {
    const auto seen = this->person_->draft();
    ASSERT_TRUE(seen) << "something was done before crash " << ++crashes_;
    this->person_->kill();
    const auto left = viewer::find_interrupted(this->person_->journals());
    ASSERT_EQ(left.size(), 1U) << "crash " << crashes_;
    this->person_->start();
    ASSERT_TRUE(this->person_->waits_for_window()) << this->person_->errors();
    this->desktop_->settled_picture();
    this->person_->keys("Return");
    ASSERT_TRUE(
        test::eventually(this->kPatienceSeconds, [&] { return !fs::exists(left[0].journal); }))
        << "crash " << crashes_ << ": nobody took the edit over";
    ASSERT_TRUE(this->person_->eventually_is([&](const Draft& now) {
      return now.steps == left[0].draft.steps && now.open == left[0].draft.open;
    })) << "crash "
        << crashes_;
    this->desktop_->settled_picture();
    this->person_->look_from(view, positions);
  }

  // What was saved, mesh and recipe, is the same surface.
  void expect_saves_what_its_recipe_makes(const fs::path& mesh) {
    const fs::path recipe = this->folder_ / "session.json";
    ASSERT_TRUE(this->saves_as("ctrl+e", recipe));
    ASSERT_TRUE(this->saves_as("ctrl+shift+s", mesh));
    this->expect_quits_silently();
    VulkanKernels kernels;
    const Mesh replayed = run_recipe(read_recipe(recipe), kernels)->mesh;
    const Mesh saved = read_mesh(mesh);
    ASSERT_EQ(saved.face_vertices(), replayed.face_vertices());
    EXPECT_LT(test::largest_distance(saved.positions, replayed.positions),
              1e-5 * bounds_of(saved.positions).diagonal());
  }

 private:
  int crashes_ = 0;
};

class EditingSessions : public Session<Editing> {
 protected:
  // A disk around a place of the tube that faces the person.
  void drag_disk(double z, double radius) {
    person_->drag_disk({0.5, 0.0, z}, {0.5, 0.0, z + radius});
  }

  // Region and handle by disks, as the guide says it.
  void choose_disks(double z) {
    person_->keys("d i");
    drag_disk(z, 1.0);
    ASSERT_TRUE(has_disk_as_roi());
    person_->keys("h");
    drag_disk(z, 0.3);
    ASSERT_TRUE(has_handles(1));
    person_->keys("m");
    desktop_->settled_picture();
  }

  bool is_moved_and_settled() {
    return person_->eventually_is([](const Draft& d) {
      return d.settled && !d.open.handles.empty() &&
             !(d.open.handles.at(0).move == Move(SimilarityMove{}));
    });
  }

  void crash() { crash_and_restore(View::right, mesh_.positions); }
};

TEST_F(EditingSessions, TheFirstEdit) {
  open_tube();
  person_->keys("d i");
  drag_disk(3.0, 1.0);
  ASSERT_TRUE(has_disk_as_roi());
  crash();
  choose_disks(3.0);
  // In the middle of a drag, which is no step yet.
  const Vector2d arrow =
      test::middle_of(gizmo(GizmoMode::translate), GizmoPart::y, person_->projection());
  person_->hold({arrow, arrow - Vector2d(0.0, 40.0)});
  crash();
  person_->let_go();
  EXPECT_EQ(move(), SimilarityMove{}) << "the drag was not done";
  person_->keys("m");
  drag_part(GizmoMode::translate, GizmoPart::y, {0.0, -60.0});
  ASSERT_TRUE(is_moved_and_settled());
  keep_picture("session-first-edit");
  crash();
  ASSERT_TRUE(settles());
  EXPECT_GT(move().translate.y(), 0.05);
  expect_saves_what_its_recipe_makes(folder_ / "edited.obj");
}

TEST_F(EditingSessions, ASecondEditElsewhere) {
  open_tube();
  choose_disks(4.0);
  drag_part(GizmoMode::translate, GizmoPart::y, {0.0, -60.0});
  ASSERT_TRUE(is_moved_and_settled());
  crash();
  person_->keys("d");
  drag_disk(1.5, 0.8);
  ASSERT_TRUE(has_steps(1)) << "a disk elsewhere begins the next edit";
  crash();
  person_->keys("d h");
  drag_disk(1.5, 0.3);
  ASSERT_TRUE(has_handles(1));
  person_->keys("m g");
  person_->type("0.3");
  person_->keys("Return");
  ASSERT_TRUE(is_moved_and_settled());
  keep_picture("session-second-edit");
  crash();
  EXPECT_EQ(person_->draft()->steps.size(), 1U);
  person_->keys("ctrl+n");
  ASSERT_TRUE(has_steps(2)) << "the key for a new edit ends this one";
  EXPECT_TRUE(has_handles(0));
  person_->keys("ctrl+z");
  ASSERT_TRUE(has_handles(1));
  expect_saves_what_its_recipe_makes(folder_ / "edited.obj");
}

TEST_F(EditingSessions, AMirroredEdit) {
  open_tube();
  person_->keys("shift+m");
  ASSERT_TRUE(person_->eventually_is([](const Draft& d) { return d.open.mirror.has_value(); }));
  crash();
  choose_disks(4.5);
  crash();
  drag_part(GizmoMode::translate, GizmoPart::y, {0.0, -60.0});
  ASSERT_TRUE(is_moved_and_settled());
  keep_picture("session-mirror");
  crash();
  EXPECT_TRUE(person_->draft()->open.mirror.has_value());
  expect_saves_what_its_recipe_makes(folder_ / "edited.obj");
}

class LayerSessions : public Session<Layers> {
 protected:
  void crash() { crash_and_restore(View::front, sheet_.positions); }
};

TEST_F(LayerSessions, ACoatFromAnotherMesh) {
  choose_target();
  choose_coat();
  // What stands at the desk is no step yet: the target is kept.
  crash();
  EXPECT_TRUE(has_steps(0));
  choose_coat();
  person_->keys("ctrl+Return");
  ASSERT_TRUE(has_steps(1));
  keep_picture("session-coat");
  crash();
  EXPECT_EQ(std::get<CoatStep>(person_->draft()->steps.at(0)).source.mesh, files_.relief());
  person_->keys("ctrl+z");
  ASSERT_TRUE(has_steps(0));
  crash();
  // The coat that was restored is one step: before it nothing was chosen.
  choose_target();
  choose_coat();
  keep_picture("session-coat-again");
  person_->keys("ctrl+Return");
  ASSERT_TRUE(has_steps(1)) << "once more";
  expect_saves_what_its_recipe_makes(folder_ / "coated.ply");
}

TEST_F(LayerSessions, AMix) {
  choose_target();
  crash();
  choose_mix();
  keep_picture("session-mix-sources");
  // While it is carried out, or right after.
  person_->keys("ctrl+Return");
  test::sleep_seconds(0.02);
  crash();
  const bool was_done = person_->draft()->steps.size() == 1;
  if (!was_done) {
    choose_mix();
    person_->keys("ctrl+Return");
  }
  ASSERT_TRUE(has_steps(1));
  const auto mix = std::get<MixStep>(person_->draft()->steps.at(0));
  EXPECT_EQ(mix.sources[0].mesh, files_.relief());
  EXPECT_TRUE(mix.sources[1].mesh.empty()) << "the mesh itself";
  keep_picture("session-mix");
  crash();
  expect_saves_what_its_recipe_makes(folder_ / "mixed.ply");
}

class TransplantSessions : public Session<Transplanting> {
 protected:
  void crash() { crash_and_restore(View::front, mesh_.positions); }

  void put_finger(const Eigen::Vector3d& place) {
    person_->keys("n");
    ASSERT_TRUE(carries_to(person_->pixel_of(place)));
    person_->click(person_->pixel_of(place));
    desktop_->settled_picture();
  }
};

TEST_F(TransplantSessions, TwoFingers) {
  const Eigen::Vector3d left = Eigen::Vector3d(-0.4, 0.2, 0.9).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d(0.5, 0.1, 0.85).normalized();
  put_finger(left);
  keep_picture("session-transplant-set-down");
  person_->keys("Return");
  ASSERT_TRUE(has_steps(1));
  crash();
  // A part in hand is no step.
  put_finger(right);
  crash();
  ASSERT_TRUE(has_steps(1));
  put_finger(right);
  person_->keys("Return");
  ASSERT_TRUE(has_steps(2));
  keep_picture("session-transplant");
  crash();
  expect_saves_what_its_recipe_makes(folder_ / "hand.ply");
}

class RepairSessions : public Session<Doctor> {};

TEST_F(RepairSessions, ARepairedBallIsEdited) {
  const fs::path broken = folder_ / "ball.obj";
  const fs::path repaired = folder_ / "ball-repaired.obj";
  write_mesh(broken_ball(), broken);
  open_named(broken);
  const Vector2d banner = problem().value();
  press_keep(banner, press(banner, kSecond));
  person_->keys("Return");
  ASSERT_TRUE(is_open("ball-repaired.obj"));
  const Positions ball = read_mesh(repaired).positions;
  const auto crash = [&] { crash_and_restore(View::front, ball); };
  const auto drag_disk = [&](double radius) {
    person_->drag_disk({0.0, 0.0, 1.0}, Vector3d(radius, 0.0, 1.0).normalized());
  };
  desktop_->settled_picture();
  person_->look_from(View::front, ball);
  person_->keys("d i");
  drag_disk(0.7);
  ASSERT_TRUE(has_disk_as_roi());
  crash();
  person_->keys("d h");
  drag_disk(0.2);
  ASSERT_TRUE(has_handles(1));
  crash();
  person_->keys("m g");
  person_->type("0.4");
  person_->keys("Return");
  ASSERT_TRUE(person_->eventually_is([](const Draft& d) { return d.settled; }));
  keep_picture("session-repair");
  crash();
  expect_saves_what_its_recipe_makes(folder_ / "edited.obj");
  EXPECT_TRUE(check(read_mesh(broken)).has_problems()) << "the file stays as it was";
}

}  // namespace
}  // namespace lapwing
