// A mesh with a texture in the viewer: shown, moved, sewn to another, and left out.
#include <fstream>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "run/transplant_runs.h"
#include "support/environment.h"
#include "support/gpu.h"
#include "support/keep_picture.h"
#include "viewer_panels/shown_viewer.h"

namespace lapwing::viewer::test {
namespace {

constexpr Index kSide = 24;

constexpr const char* kBump = R"({"op": "deform",
    "roi": {"disk": {"near": [0.5, 0.5, 0], "radius": 0.3}},
    "handles": [{"region": {"disk": {"near": [0.5, 0.5, 0], "radius": 0.1}},
                 "move": {"translate": [0, 0, 0.3]}}]})";

// An upright sheet, whose texture coordinates are its x and y, in an image that is all red.
class TexturedSheet : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    viewer_ = std::make_unique<ShownViewer>(std::make_shared<gpu::Context>());
    Mesh sheet = grid(kSide, kSide);
    MeshAttributes& a = sheet.edit_attributes();
    for (const Eigen::Vector3d& p : sheet.positions) a.uvs.emplace_back(p.head<2>());
    a.corner_uvs = sheet.face_vertices();
    a.material_libraries = {"sheet.mtl"};
    a.materials = {"skin"};
    a.face_materials.assign(sheet.face_count(), 0);
    write_mesh(sheet, file("sheet.obj"));
    std::ofstream(file("sheet.mtl")) << "newmtl skin\nKd 0 1 0\nmap_Kd skin.png\n";
    write_png(file("skin.png"), {1, 1, {230, 20, 20, 255}});
  }

  std::filesystem::path file(const char* name) const { return viewer_->folder() / name; }
  std::filesystem::path recipe(const std::string& steps) const {
    std::ofstream(file("steps.json"))
        << R"({"lapwing": 1, "mesh": "sheet.obj", "steps": [)" << steps << "]}";
    return file("steps.json");
  }

  // Which part of the picture has a colour in which red, or green, is much the strongest.
  double share(std::size_t channel, const std::string& name) {
    const Image picture = viewer_->picture();
    lapwing::test::keep_picture(picture, name);
    std::size_t count = 0;
    for (std::size_t at = 0; at < picture.rgba.size(); at += 4) {
      const int own = picture.rgba[at + channel];
      const int other = std::max(picture.rgba[at + 1 - channel], picture.rgba[at + 2]);
      if (own > 2 * other) ++count;
    }
    return static_cast<double>(count) / (picture.width * picture.height);
  }
  double red(const std::string& name) { return share(0, name); }
  double green(const std::string& name) { return share(1, name); }

  std::unique_ptr<ShownViewer> viewer_;
};

TEST_F(TexturedSheet, ShowsItsImageUntilThatIsTurnedOff) {
  viewer_->open(file("sheet.obj"));
  const double shown = red("textured-sheet");
  EXPECT_GT(shown, 0.1);
  viewer_->click("Display");
  viewer_->click("Plain");
  EXPECT_NEAR(red("textured-sheet-plain"), shown, 0.01);
  viewer_->click("File colours");
  EXPECT_LT(red("clay-sheet"), 0.01);
  viewer_->click("Mesh");
  EXPECT_TRUE(viewer_->shows("1 (with images: 1)"));
}

TEST_F(TexturedSheet, KeepsItsImageWhereItIsMoved) {
  viewer_->open(recipe(kBump));
  EXPECT_GT(red("textured-sheet-moved"), 0.1);
}

// The surface that is edited has no vertices of its own for each triangle.
TEST_F(TexturedSheet, KeepsItsImageWhereSeamsAreJoined) {
  Mesh soup = read_mesh(file("sheet.obj"));
  Positions corners;
  for (const Index v : soup.face_vertices()) corners.push_back(soup.positions[v]);
  std::iota(soup.edit_faces().vertices.begin(), soup.edit_faces().vertices.end(), 0U);
  soup.positions = std::move(corners);
  write_mesh(soup, file("sheet.obj"));
  viewer_->open(recipe(kBump));
  EXPECT_GT(red("textured-soup"), 0.1);
}

TEST_F(TexturedSheet, KeepsItsImageBesideAPartThatHasNone) {
  write_mesh(lapwing::test::finger(24, 12, 0.2, 0.6), file("finger.ply"));
  viewer_->open(recipe(R"({"op": "transplant", "part": "finger.ply",
      "target_region": {"disk": {"near": [0.5, 0.5, 0], "radius": 0.2}}})"));
  EXPECT_GT(red("textured-sheet-with-finger"), 0.05);
}

TEST_F(TexturedSheet, KeepsItsImageWhileAPartIsInHand) {
  const lapwing::test::Environment data("XDG_DATA_HOME", viewer_->folder() / "data");
  add_finger(viewer_->folder());
  viewer_->open(file("sheet.obj"));
  viewer_->key('N');
  viewer_->wait_for([&] { return viewer_->says("Shift+wheel rotates"); }, "the part is in hand");
  const double alone = red("textured-sheet");
  viewer_->app().handle({.kind = InputKind::move, .position = {850.0, 400.0}});
  const double beside = red("textured-sheet-and-part");
  EXPECT_LT(beside, 0.98 * alone) << "the part covers some";
  EXPECT_GT(beside, 0.2 * alone);
}

TEST_F(TexturedSheet, SaysWhichImageIsMissingAndHasItsMaterialsColor) {
  std::filesystem::remove(file("skin.png"));
  viewer_->open(file("sheet.obj"));
  viewer_->look_at();
  EXPECT_TRUE(viewer_->says("Image 'skin.png' is not beside"));
  EXPECT_GT(green("green-sheet"), 0.1);
}

TEST_F(TexturedSheet, AnotherMeshWithoutColorsIsPlain) {
  viewer_->open(file("sheet.obj"));
  ASSERT_GT(red("textured-sheet"), 0.1);
  write_mesh(grid(kSide, kSide), file("other.obj"));
  viewer_->app().open(file("other.obj"));
  viewer_->wait_for([&] { return red("plain-sheet") < 0.01; }, "the other mesh shows");
  viewer_->click("Display");
  EXPECT_TRUE(viewer_->shows("Wireframe"));
  EXPECT_FALSE(viewer_->shows("File colours"));
}

}  // namespace
}  // namespace lapwing::viewer::test
