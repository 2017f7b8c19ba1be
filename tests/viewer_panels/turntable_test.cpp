// A turntable is saved from the viewer while its window stays alive.
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/gpu.h"
#include "support/stand_in_ffmpeg.h"
#include "ui/turntable_recording.h"
#include "viewer_panels/shown_viewer.h"

namespace lapwing::viewer::test {
namespace {

using lapwing::test::StandInFfmpeg;
using ::testing::HasSubstr;

class ASavedTurntable : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    context_ = std::make_shared<gpu::Context>();
    mesh_ = icosphere(2);
    surface_ = std::make_unique<Surface>(context_, mesh_.positions, mesh_.topology());
    paint_ = std::make_unique<SurfacePaint>(*surface_);
  }

  std::unique_ptr<TurntableRecording> begin(const std::string& name, int count) {
    const Turntable way(mesh_.positions, view_axes(View::three_quarter), UpAxis::y, 1.0);
    return std::make_unique<TurntableRecording>(
        TurntableRecording::Order{folder_ / name, count, 30.0}, way, *context_,
        RenderOptions{.width = 64, .height = 64}, [] {});
  }
  void go_on(TurntableRecording& recording) { recording.go_on(*surface_, *paint_, {}); }
  std::string text_of(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }

  TemporaryFolder folder_;
  std::shared_ptr<gpu::Context> context_;
  Mesh mesh_;
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<SurfacePaint> paint_;
};

TEST_F(ASavedTurntable, HasThePicturesInTheirOrder) {
  const StandInFfmpeg ffmpeg(folder_.path());
  const auto recording = begin("a.mp4", 7);
  while (!recording->is_done()) go_on(*recording);
  EXPECT_EQ(recording->written(), 7);
  std::string expected;
  ImageRenderer renderer(*context_, {.width = 64, .height = 64});
  const Turntable way(mesh_.positions, view_axes(View::three_quarter), UpAxis::y, 1.0);
  for (int step = 0; step < 7; ++step) {
    const Image image = renderer.render(*surface_, *paint_, way.camera(step, 7));
    expected.append(image.rgba.begin(), image.rgba.end());
  }
  EXPECT_TRUE(text_of("a.mp4") == expected);
}

TEST_F(ASavedTurntable, ThatIsGivenUpLeavesWholePicturesAndNoVideo) {
  const StandInFfmpeg ffmpeg(folder_.path());
  for (const char* name : {"a.mp4", "a.png"}) {
    const auto recording = begin(name, 50);
    while (recording->written() < 3) go_on(*recording);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mp4"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a-0003.png"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a-0050.png"));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    EXPECT_EQ(entry.path().string().find(".tmp-"), std::string::npos) << entry.path();
  }
}

TEST_F(ASavedTurntable, ThatCannotBeWrittenSaysSoOnce) {
  const StandInFfmpeg ffmpeg(folder_.path(), "cat > /dev/null; echo no room >&2; exit 1");
  const auto recording = begin("a.gif", 2);
  std::string said;
  while (said.empty()) {
    try {
      go_on(*recording);
    } catch (const IoError& error) {
      said = error.what();
    }
  }
  EXPECT_THAT(said, HasSubstr("no room"));
  go_on(*recording);
  EXPECT_FALSE(recording->is_done());
}

// From the menu's key to the files.
class ATurntableOfTheViewer : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    viewer_ =
        std::make_unique<ShownViewer>(std::make_shared<gpu::Context>(), Look{.size = {640, 480}});
    write_mesh(rippled_cylinder(24, 41), viewer_->folder() / "tube.obj");
    viewer_->open(viewer_->folder() / "tube.obj");
  }
  void begin() {
    viewer_->key('P', {.shift = true, .control = true});
    ASSERT_TRUE(viewer_->shows("Save turntable"));
    viewer_->click("Save as...");
    viewer_->wait_for([&] { return viewer_->says("an image sequence (png)"); },
                      "the window asks for a file");
    viewer_->click("Save");
  }

  std::unique_ptr<ShownViewer> viewer_;
};

TEST_F(ATurntableOfTheViewer, IsSavedWhileTheWindowIsDrawn) {
  const StandInFfmpeg ffmpeg(viewer_->folder());
  begin();
  viewer_->wait_for([&] { return viewer_->says(" of 120 frames"); }, "it is being saved");
  viewer_->wait_for([&] { return viewer_->says("Saved "); }, "it is saved");
  EXPECT_EQ(std::filesystem::file_size(viewer_->folder() / "tube-turntable.mp4"),
            120U * 640 * 480 * 4);
  EXPECT_FALSE(viewer_->says(" of 120 frames"));
  viewer_->click("File");
  EXPECT_TRUE(viewer_->shows("Quit")) << "and the menus can be used again";
}

TEST_F(ATurntableOfTheViewer, IsCancelledByEscape) {
  const StandInFfmpeg ffmpeg(viewer_->folder());
  begin();
  viewer_->wait_for([&] { return viewer_->says(" of 120 frames"); }, "some frames are written");
  viewer_->click("File");
  EXPECT_FALSE(viewer_->shows("Quit")) << "nothing else can be done beside it";
  viewer_->key(kEscape);
  EXPECT_TRUE(viewer_->says("Cancelled: the turntable"));
  EXPECT_FALSE(viewer_->says(" of 120 frames"));
  EXPECT_FALSE(std::filesystem::exists(viewer_->folder() / "tube-turntable.mp4"));
}

TEST_F(ATurntableOfTheViewer, WithoutFfmpegIsNumberedPictures) {
  const lapwing::test::Environment path("PATH", viewer_->folder().string());
  begin();
  // The first image counts as saved before the second is begun.
  viewer_->wait_for(
      [&] { return std::filesystem::exists(viewer_->folder() / "tube-turntable-0002.png"); },
      "some are written");
  viewer_->click("Cancel");
  EXPECT_TRUE(viewer_->says("only the first"));
  EXPECT_FALSE(viewer_->says("first 1 frames"));
  EXPECT_TRUE(std::filesystem::exists(viewer_->folder() / "tube-turntable-0001.png"));
}

}  // namespace
}  // namespace lapwing::viewer::test
