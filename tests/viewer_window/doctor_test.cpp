// A person opens broken meshes in a real window, by real events.
#include "lapwing/doctor/check.h"
#include "viewer_window/doctor_window.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;

TEST_F(Doctor, SaysNothingOfASoundMesh) {
  write_mesh(icosphere(3), folder_ / "ball.obj");
  EXPECT_FALSE(problem_in(open_named(folder_ / "ball.obj")));
  expect_quits_silently();
}

TEST_F(Doctor, ShowsWhatIsWrongAndTheWayBack) {
  write_mesh(broken_ball(), folder_ / "ball.obj");
  open_named(folder_ / "ball.obj");
  const auto found = problem();
  ASSERT_TRUE(found);
  const Image opened = desktop_->settled_picture();
  test::keep_picture(opened, "doctor-banner");
  const Image shown = press(*found, kFirst);
  test::keep_picture(shown, "doctor-shows");
  EXPECT_GT(test::mean_difference(shown, opened), 0.5);
  person_->click(*found + Vector2d(kFirst, 42.0));
  person_->move_to({900, 700});
  EXPECT_TRUE(shows(opened, 0.3));
  press(*found, kThird);
  EXPECT_FALSE(problem_in(desktop_->settled_picture())) << "ignored";
  expect_quits_silently();
}

TEST_F(Doctor, PreviewsARepairAndKeepsItAsAFileThatIsOpen) {
  write_mesh(broken_ball(), folder_ / "ball.obj");
  open_named(folder_ / "ball.obj");
  const auto found = problem();
  ASSERT_TRUE(found);
  const Image preview = press(*found, kSecond);
  test::keep_picture(preview, "doctor-preview");
  EXPECT_FALSE(problem_in(preview));
  EXPECT_FALSE(fs::exists(folder_ / "ball-repaired.obj")) << "nothing is kept unasked";
  press_keep(*found, preview);
  keep_picture("doctor-keeps");
  person_->keys("Return");
  EXPECT_TRUE(is_open("ball-repaired.obj"));
  const Image kept = desktop_->settled_picture();
  test::keep_picture(kept, "doctor-kept");
  EXPECT_FALSE(problem_in(kept));
  EXPECT_FALSE(check(read_mesh(folder_ / "ball-repaired.obj")).has_problems());
  EXPECT_TRUE(check(read_mesh(folder_ / "ball.obj")).has_problems()) << "the file stays as it was";
  expect_quits_silently();
}

TEST_F(Doctor, AMeshWithoutFacesSaysSoWhereItWouldBe) {
  for (const auto& [name, content] :
       {std::pair{"cloud.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"}, {"empty.obj", "# nothing\n"}}) {
    open_named(folder_.file(name, content));
    EXPECT_TRUE(problem()) << name;
    keep_picture(std::string("doctor-") + name);
    expect_quits_silently();
  }
}

}  // namespace
}  // namespace lapwing
