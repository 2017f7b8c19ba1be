// Every panel in both themes, one on a small window, the other on a large one of a desktop that
// enlarges (places depend on the window alone, colours on the theme): all of its texts are whole
// and can be read.
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/environment.h"
#include "support/gpu.h"
#include "support/keep_picture.h"
#include "viewer_panels/bent_tube.h"
#include "viewer_panels/shown_viewer.h"

namespace lapwing::viewer::test {
namespace {

using Eigen::Vector2d;

// WCAG 2.1, 1.4.3.
constexpr double kLeastContrast = 4.5;

class Panels : public ::testing::TestWithParam<Look> {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    viewer_ = std::make_unique<ShownViewer>(std::make_shared<gpu::Context>(), GetParam());
    data_.emplace("XDG_DATA_HOME", viewer_->folder() / "data");
    add_finger(viewer_->folder());
    write_mesh(rippled_cylinder(24, 41), viewer_->folder() / "tube.obj");
  }

  // The tube with a handle that was moved; far, and the certificate has much to say.
  void open_bent(int by = 9) {
    viewer_->open(write_bent_tube(viewer_->folder(), by));
    viewer_->wait_for([&] { return viewer_->says("Ready: refines while dragging"); },
                      "the edit is prepared");
  }

  // Until it has settled.
  void move_handle() {
    viewer_->key('G');
    viewer_->key('X');
    viewer_->type(U'7');
    viewer_->key(kEnter);
    viewer_->wait_for([&] { return viewer_->says("Stretch"); }, "the result is there");
  }

  // Reads and keeps what is on the screen.
  void check(const std::string& name) {
    const Look& look = GetParam();
    for (const ShownText& text : viewer_->look_at()) {
      EXPECT_FALSE(text.is_cut) << name << ": cut off: \"" << text.words << '"';
      EXPECT_GE(text.contrast, kLeastContrast) << name << ": pale: \"" << text.words << '"';
    }
    const std::string theme = look.theme == Theme::light ? "light" : "dark";
    lapwing::test::keep_picture(viewer_->picture(),
                                name + "-" + theme + "-" + std::to_string(look.size.width) + "-" +
                                    std::to_string(std::lround(10.0 * look.scale)));
  }
  void check_menu(const std::string& menu) {
    viewer_->click(menu);
    check("menu-" + menu);
    viewer_->click(menu);
  }

  std::unique_ptr<ShownViewer> viewer_;
  std::optional<lapwing::test::Environment> data_;
};

TEST_P(Panels, OfTheStartAreWhole) {
  viewer_->look_at();
  check("start");
}

TEST_P(Panels, OfADeformAreWhole) {
  open_bent();
  EXPECT_TRUE(viewer_->says("Stretch")) << "a recipe that was opened is certified";
  check("deform");
  viewer_->click("Selection");
  viewer_->click("Solver settings");
  check("deform-parameters");
  viewer_->click("Solver settings");
  viewer_->click("Selection");
  viewer_->point_at("Grow");
  check("tooltip");
  viewer_->click("Brush");
  check("deform-brush");
  viewer_->key('P', {.shift = true});
  viewer_->click("Rigid");
  viewer_->scroll_to("10");
  ASSERT_TRUE(viewer_->shows("10")) << "the factor";
  check("deform-stiffness");
  for (const char* tab : {"Deform", "Coat", "Mix", "Wrap", "Transplant", "Mesh", "Display"}) {
    EXPECT_TRUE(viewer_->shows(tab)) << tab;
  }
  // Each with something that it alone has.
  for (const auto& [tab, own] : {std::pair{"Coat", "New coat"},
                                 {"Mix", "New mix"},
                                 {"Wrap", "Open scan..."},
                                 {"Transplant", "finger"},
                                 {"Mesh", "Mean edge length"},
                                 {"Display", "Show guide"}}) {
    viewer_->click(tab);
    viewer_->scroll_to(own);
    ASSERT_TRUE(viewer_->shows(own)) << tab;
    check(std::string("tab-") + tab);
  }
}

TEST_P(Panels, OfMenusAndDialogsAreWhole) {
  open_bent();
  for (const char* menu : {"File", "Edit", "View", "Help"}) check_menu(menu);
  viewer_->key('P', kControl);
  ASSERT_TRUE(viewer_->shows("Save image"));
  check("dialog-picture");
  viewer_->key(kEscape);
  viewer_->key('P', kControlShift);
  ASSERT_TRUE(viewer_->shows("Save turntable"));
  check("dialog-turntable");
  viewer_->key(kEscape);
  viewer_->type(U'?');
  ASSERT_TRUE(viewer_->shows("Keys"));
  check("dialog-controls");
  viewer_->key(kEscape);
  viewer_->click("Help");
  viewer_->click("System info");
  check("dialog-machine");
  viewer_->key(kEscape);
  viewer_->app().open(viewer_->folder() / "a file with quite a long name that is not there.obj");
  viewer_->wait_for([&] { return viewer_->shows("Close"); }, "the error is said");
  check("toast");
  viewer_->click("Help");
  viewer_->click("Messages");
  check("dialog-messages");
  viewer_->key(kEscape);
  move_handle();
  viewer_->key('Q', kControl);
  ASSERT_TRUE(viewer_->shows("Discard"));
  check("dialog-unsaved");
}

TEST_P(Panels, OfACoatAreWhole) {
  open_bent();
  viewer_->key('K', kControl);
  viewer_->wait_for([&] { return viewer_->says("Source: "); }, "the coat begins");
  check("coat-begun");
  viewer_->click("Use whole source");
  check("coat-patch");
  viewer_->click("Solver settings");
  check("coat-parameters");
  viewer_->click("Solver settings");
  viewer_->click("Domain");
  check("coat-domain");
}

TEST_P(Panels, OfAMixAreWhole) {
  open_bent();
  viewer_->key('M', kControl);
  viewer_->wait_for([&] { return viewer_->says("Source: "); }, "the mix begins");
  check("mix-begun");
  viewer_->click("Around a handle");
  check("mix-around");
}

TEST_P(Panels, OfATransplantAreWhole) {
  viewer_->open(viewer_->folder() / "tube.obj");
  viewer_->key('N');
  viewer_->wait_for([&] { return viewer_->says("Click to place"); }, "the part is in hand");
  check("transplant-carried");
  viewer_->click("More parts");
  check("transplant-more");
}

TEST_P(Panels, OfTheBrowserAreWhole) {
  const lapwing::test::Environment no_programs("PATH", "");  // no dialogs of the desktop
  std::filesystem::create_directories(viewer_->folder() / "scans of last year" / "raw");
  viewer_->open(viewer_->folder() / "tube.obj");
  for (const auto& [key, modifiers, button] :
       {std::tuple{'O', kControl, "Open"}, {'S', kControlShift, "Save"}, {'E', kControl, "Save"}}) {
    viewer_->key(key, modifiers);
    viewer_->wait_for(
        [&, button = button] { return viewer_->shows(button) && viewer_->shows("Cancel"); },
        "the browser is there");
    check(std::string("browser-") + static_cast<char>(key));
    viewer_->key(kEscape);
  }
  viewer_->key('O', kControl);
  viewer_->look_at();
  for (const char letter : std::string("nothing.obj")) {
    viewer_->send({.kind = InputKind::key, .key = std::toupper(letter)});
    viewer_->send({.kind = InputKind::text, .text = static_cast<char32_t>(letter)});
  }
  viewer_->send({.kind = InputKind::key, .key = kEnter});
  viewer_->wait_for([&] { return viewer_->says("There is no file"); },
                    "that it is not there is said");
  check("browser-refuses");
}

// Of a ball with a face twice and vertices without a face.
TEST_P(Panels, OfTheDoctorAreWhole) {
  Mesh ball = icosphere(3);
  ball.add_face(std::vector<Index>(ball.face(100).begin(), ball.face(100).end()));
  for (int k = 0; k < 12; ++k) ball.positions.emplace_back(1.4, 0.1 * k, 0.0);
  write_mesh(ball, viewer_->folder() / "broken.obj");
  viewer_->open(viewer_->folder() / "broken.obj");
  viewer_->wait_for([&] { return viewer_->shows("Repair"); }, "a repair is offered");
  check("doctor-offer");
  viewer_->click("Show");
  check("doctor-places");
  viewer_->click("Back");
  viewer_->click("Repair");
  viewer_->wait_for([&] { return viewer_->shows("Save repaired mesh..."); }, "the repair is shown");
  check("doctor-preview");
  std::ofstream(viewer_->folder() / "cloud.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  viewer_->open(viewer_->folder() / "cloud.obj");
  viewer_->wait_for([&] { return viewer_->shows("Open another file..."); }, "nothing is there");
  check("doctor-empty");
}

// However many lines it takes.
TEST_P(Panels, OfMessagesOfAllLengthsAreWhole) {
  viewer_->open(viewer_->folder() / "tube.obj");
  for (std::size_t letters = 1; letters < 60; letters += 4) {
    const std::string name = std::string(letters, 'i') + ".obj";
    viewer_->app().open(viewer_->folder() / name);
    viewer_->wait_for([&] { return viewer_->shows("Close"); }, name + " is said");
    check("toast-of-" + std::to_string(letters));
    viewer_->click("Close");
    EXPECT_FALSE(viewer_->shows("Close"));
  }
}

// Whatever there is to say of a result, no other control moves for it.
TEST_P(Panels, TheCertificateMovesNothing) {
  viewer_->open(viewer_->folder() / "tube.obj");
  std::map<std::string, ImVec2> places;
  const auto remember = [&] {
    places.clear();
    for (const char* label : {"Selection", "Grow", "Mirror", "Undo", "Save recipe..."}) {
      // A low window shows only part of the sidebar.
      if (const auto text = find_text(viewer_->look_at(), label)) places[label] = text->min;
    }
    ASSERT_TRUE(places.contains("Undo"));
  };
  const auto expect_as_before = [&] {
    for (const auto& [label, place] : places) {
      const auto text = find_text(viewer_->look_at(), label);
      ASSERT_TRUE(text) << label;
      EXPECT_EQ(text->min.x, place.x) << label;
      EXPECT_EQ(text->min.y, place.y) << label;
    }
  };
  open_bent(0);
  remember();
  EXPECT_FALSE(viewer_->says("Stretch"));
  move_handle();
  check("deform-result");
  expect_as_before();
}

std::string name_of(const ::testing::TestParamInfo<Look>& info) {
  return (info.param.theme == Theme::light ? "Light" : "Dark") +
         std::to_string(info.param.size.width) + "By" +
         std::to_string(std::lround(10.0 * info.param.scale));
}

INSTANTIATE_TEST_SUITE_P(Looks, Panels,
                         ::testing::Values(Look{Theme::dark, {1280, 800}, 1.0},
                                           Look{Theme::light, {2560, 1600}, 2.0},
                                           Look{Theme::dark, {640, 480}, 1.0},
                                           Look{Theme::light, {1280, 800}, 2.0},
                                           Look{Theme::light, {1280, 800}, 1.5}),
                         name_of);

}  // namespace
}  // namespace lapwing::viewer::test
