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
using Eigen::Vector2d;
using test::Desktop;
using test::Person;
using ::testing::IsEmpty;

constexpr std::size_t kKeys = 200;
// Of the display, where neither the menu nor the status line is, and the status line tells times.
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

  // What shows right of a column.
  Image part(const Image& screen, std::uint32_t left) const {
    Image part{screen.width - left, kBottom - kTop, {}};
    for (std::uint32_t y = kTop; y < kBottom; ++y) {
      for (std::uint32_t x = left; x < screen.width; ++x) {
        const auto pixel = screen.pixel(x, y);
        part.rgba.insert(part.rgba.end(), pixel.begin(), pixel.end());
      }
    }
    return part;
  }

  void expect_discards_silently() {
    EXPECT_EQ(person_->discard_and_quit(), 0);
    EXPECT_THAT(person_->errors(), IsEmpty());
  }
};

TEST_F(FramesInAWindow, TextTypedFastArrivesWholeWhileAnEditIsPrepared) {
  open_mesh(icosphere(6));
  person_->look_from(View::front, icosphere(6).positions);
  person_->keys("b");
  person_->keys("i");
  person_->drag({{400, 60}, {640, 400}, {900, 700}});
  ASSERT_TRUE(person_->eventually_is([](const viewer::Draft& d) {
    return std::holds_alternative<ListedVertices>(d.open.roi.form);
  }));
  person_->keys("h");
  person_->drag({{600, 60}, {640, 150}, {700, 200}});  // the edit is prepared from now on
  ASSERT_TRUE(
      person_->eventually_is([](const viewer::Draft& d) { return d.open.handles.size() == 1; }));
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

TEST_F(FramesInAWindow, APanelThatChangesLeavesTheSurfaceAsItIs) {
  open_mesh(icosphere(4));
  constexpr std::uint32_t kBesideTheMenu = 400;
  person_->move_to({20, 10});  // the tool marks where the cursor is
  const Image before = desktop_->settled_picture();
  person_->click({20, 10});  // the File menu
  const Image with_menu = desktop_->settled_picture();
  EXPECT_GT(test::mean_difference(with_menu, before), 0.5);
  EXPECT_EQ(part(with_menu, kBesideTheMenu).rgba, part(before, kBesideTheMenu).rgba);
  person_->keys("Escape");
  EXPECT_EQ(part(desktop_->settled_picture(), kBesideTheMenu).rgba,
            part(before, kBesideTheMenu).rgba);
  EXPECT_EQ(person_->quit(), 0);
  EXPECT_THAT(person_->errors(), IsEmpty());
}

TEST_F(FramesInAWindow, AfterADragOfTheViewThePictureIsTheOneDrawnAnew) {
  open_mesh(icosphere(6));
  person_->open_dialog("Tab");  // waits until the panels are gone
  person_->drag({{300, 300}, {340, 310}, {420, 330}, {500, 380}});
  const Image still = desktop_->settled_picture();
  person_->keys("Tab key shift+l");
  ASSERT_TRUE(test::eventually(
      30.0, [&] { return test::mean_difference(desktop_->picture(), still) > 0.5; }));
  desktop_->settled_picture();
  person_->keys("Tab key shift+l");
  // The status line tells how long a frame took.
  test::eventually(30.0, [&] { return part(desktop_->picture(), 0).rgba == part(still, 0).rgba; });
  EXPECT_EQ(part(desktop_->settled_picture(), 0).rgba, part(still, 0).rgba);
  EXPECT_EQ(person_->quit(), 0);
  EXPECT_THAT(person_->errors(), IsEmpty());
}

}  // namespace
}  // namespace lapwing
