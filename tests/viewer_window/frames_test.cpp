// What a person sees and types in a real window while frames are slow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/gpu.h"
#include "viewer_window/window_test.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kKeys = 200;
// The rows of the display between the menu and the status line. The status line shows times, which
// vary.
constexpr std::uint32_t kTop = 40;
constexpr std::uint32_t kBottom = 760;

class FramesInAWindow : public test::WindowTest {
 protected:
  void open_mesh(const Mesh& mesh) {
    write_mesh(mesh, folder_ / "mesh.obj");
    person_->open(folder_ / "mesh.obj");
    ASSERT_TRUE(person_->waits_for_window()) << person_->errors();
    // Warm where the surface shows, right of the panels.
    ASSERT_TRUE(test::eventually(60.0, [&] {
      const auto pixel = desktop_->picture().pixel(800, 450);
      return pixel[0] > pixel[2];
    }));
    desktop_->settled_picture();
  }

  // Returns the rows of the screen between the menu and the status line.
  static Image middle(const Image& screen) {
    return test::part_of(screen, 0, kTop, screen.width, kBottom - kTop);
  }
};

TEST_F(FramesInAWindow, TextTypedFastArrivesWholeWhileAnEditIsPrepared) {
  open_mesh(icosphere(6));
  person_->look_from(View::front, icosphere(6).positions);
  person_->keys("b i");
  person_->drag({{400, 60}, {640, 400}, {900, 700}});
  ASSERT_TRUE(person_->eventually_is([](const viewer::Draft& d) {
    return std::holds_alternative<ListedVertices>(d.open.roi.form);
  }));
  person_->keys("h");
  person_->drag({{600, 60}, {640, 150}, {700, 200}});  // the edit is prepared from now on
  ASSERT_TRUE(has_handles(1));
  const std::string folder = folder_.path().string() + "/";
  std::string name;
  for (std::size_t k = 0; folder.size() + name.size() + 5 < kKeys; ++k) {
    name += "etaoin-shrdlu0123456789"[(7 * k) % 23];
  }
  person_->open_dialog("ctrl+e");
  desktop_->xdotool("type --delay 20 '" + folder + name + ".json'");
  person_->keys("Return");
  const fs::path saved = folder + name + ".json";
  EXPECT_EQ(saved.string().size(), kKeys);
  EXPECT_TRUE(test::eventually(30.0, [&] { return fs::exists(saved); }));
  expect_discards_silently();
}

TEST_F(FramesInAWindow, AfterADragOfTheViewThePictureIsTheOneDrawnAnew) {
  open_mesh(icosphere(6));
  person_->open_dialog("Tab");  // waits until the panels are gone
  person_->drag({{300, 300}, {340, 310}, {420, 330}, {500, 380}});
  const Image still = desktop_->settled_picture();
  person_->keys("Tab key shift+l");
  ASSERT_TRUE(differs_from(still, 0.5));
  desktop_->settled_picture();
  person_->keys("Tab key shift+l");
  // The status line shows the time of a frame.
  test::eventually(30.0, [&] { return middle(desktop_->picture()).rgba == middle(still).rgba; });
  EXPECT_EQ(middle(desktop_->settled_picture()).rgba, middle(still).rgba);
  expect_quits_silently();
}

}  // namespace
}  // namespace lapwing
