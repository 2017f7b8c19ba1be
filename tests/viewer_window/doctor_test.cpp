// A person opens broken meshes in a real window, by real events.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/doctor/check.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/gpu.h"
#include "support/keep_picture.h"
#include "viewer_window/person.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using test::Desktop;
using test::eventually;
using test::Person;
using ::testing::IsEmpty;

constexpr double kDoctorPatience = 60.0;

// A ball with a face twice and vertices without a face.
Mesh broken_ball() {
  Mesh mesh = icosphere(3);
  const std::vector<Index> corners(mesh.face(100).begin(), mesh.face(100).end());
  mesh.add_face(corners);
  for (int k = 0; k < 12; ++k) mesh.positions.emplace_back(1.4, 0.1 * k, 0.0);
  return mesh;
}

class Doctor : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_DESKTOP();
    desktop_ = std::make_unique<Desktop>(folder_.path());
    person_ = std::make_unique<Person>(*desktop_, folder_.path());
  }

  Image open(const fs::path& mesh) {
    person_->open(mesh);
    EXPECT_TRUE(person_->waits_for_window()) << person_->errors();
    EXPECT_TRUE(is_open(mesh.filename()));
    return desktop_->settled_picture();
  }
  bool is_open(const std::string& name) const {
    return eventually(kDoctorPatience, [&] {
      return !desktop_->xdotool("search --onlyvisible --name '^" + name + "'").empty();
    });
  }

  // The last line of the banner that is in the colour of problems: its left end.
  static std::optional<Vector2d> problem_in(const Image& image) {
    std::optional<Vector2d> found;
    constexpr std::uint32_t kSidebar = 380;
    for (std::uint32_t y = 0; y < image.height; ++y) {
      for (std::uint32_t x = kSidebar; x < image.width; ++x) {
        const auto pixel = image.pixel(x, y);
        if (std::abs(pixel[0] - 242) > 4 || std::abs(pixel[1] - 194) > 4 ||
            std::abs(pixel[2] - 77) > 4) {
          continue;
        }
        const double left = found ? std::min(found->x(), 1.0 * x) : x;
        found = Vector2d(left, y);
      }
    }
    return found;
  }

  // Waits for it.
  std::optional<Vector2d> problem() const {
    std::optional<Vector2d> found;
    eventually(kDoctorPatience,
               [&] { return (found = problem_in(desktop_->picture())).has_value(); });
    return found ? problem_in(desktop_->settled_picture()) : found;
  }

  // The buttons are below the line that follows.
  Image press(const Vector2d& problem, double right) {
    const Image before = desktop_->settled_picture();
    person_->click(problem + Vector2d(right, 42.0));
    EXPECT_TRUE(eventually(
        kDoctorPatience, [&] { return test::mean_difference(desktop_->picture(), before) > 0.2; }));
    return desktop_->settled_picture();
  }

  void expect_quits_silently() {
    EXPECT_EQ(person_->quit(), 0);
    EXPECT_THAT(person_->errors(), IsEmpty());
  }

  static constexpr double kFirst = 18.0;
  static constexpr double kSecond = 80.0;
  static constexpr double kThird = 145.0;

  TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;
  std::unique_ptr<Person> person_;
};

TEST_F(Doctor, SaysNothingOfASoundMesh) {
  write_mesh(icosphere(3), folder_ / "ball.obj");
  EXPECT_FALSE(problem_in(open(folder_ / "ball.obj")));
  expect_quits_silently();
}

TEST_F(Doctor, ShowsWhatIsWrongAndTheWayBack) {
  write_mesh(broken_ball(), folder_ / "ball.obj");
  open(folder_ / "ball.obj");
  const auto found = problem();
  ASSERT_TRUE(found);
  const Image opened = desktop_->settled_picture();
  test::keep_picture(opened, "doctor-banner");
  const Image shown = press(*found, kFirst);
  test::keep_picture(shown, "doctor-shows");
  EXPECT_GT(test::mean_difference(shown, opened), 0.5);
  person_->click(*found + Vector2d(kFirst, 42.0));
  person_->move_to({900, 700});
  EXPECT_TRUE(eventually(kDoctorPatience, [&] {
    return test::mean_difference(desktop_->settled_picture(), opened) < 0.3;
  }));
  press(*found, kThird);
  EXPECT_FALSE(problem_in(desktop_->settled_picture())) << "ignored";
  expect_quits_silently();
}

TEST_F(Doctor, PreviewsARepairAndKeepsItAsAFileThatIsOpen) {
  write_mesh(broken_ball(), folder_ / "ball.obj");
  open(folder_ / "ball.obj");
  const auto found = problem();
  ASSERT_TRUE(found);
  const Image preview = press(*found, kSecond);
  test::keep_picture(preview, "doctor-preview");
  EXPECT_FALSE(problem_in(preview));
  EXPECT_FALSE(fs::exists(folder_ / "ball-repaired.obj")) << "nothing is kept unasked";
  // Its buttons are one line lower or so: the first that opens the browser is "Keep".
  bool asks = false;
  for (double down = 42.0; down < 90.0 && !asks; down += 6.0) {
    person_->click(*found + Vector2d(kFirst, down));
    asks = test::mean_difference(desktop_->settled_picture(), preview) > 5.0;
  }
  ASSERT_TRUE(asks);
  test::keep_picture(desktop_->settled_picture(), "doctor-keeps");
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
  const fs::path cloud = folder_.file("cloud.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  open(cloud);
  EXPECT_TRUE(problem());
  test::keep_picture(desktop_->settled_picture(), "doctor-no-faces");
  expect_quits_silently();
  const fs::path empty = folder_.file("empty.obj", "# nothing\n");
  open(empty);
  EXPECT_TRUE(problem());
  test::keep_picture(desktop_->settled_picture(), "doctor-empty");
  expect_quits_silently();
}

}  // namespace
}  // namespace lapwing
