#include "lapwing/render/frame_writer.h"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"
#include "support/stand_in_ffmpeg.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using test::Environment;
using test::StandInFfmpeg;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

using Color = std::array<std::uint8_t, 4>;
constexpr Color kRedFrame{220, 30, 40, 255};
constexpr Color kBlueFrame{40, 60, 210, 255};

// Returns an image that is larger than any pipe or file buffer.
Image image_of(const Color& color, std::uint32_t width = 640, std::uint32_t height = 480) {
  Image image{width, height, {}};
  for (std::uint32_t k = 0; k < width * height; ++k) {
    image.rgba.insert(image.rgba.end(), color.begin(), color.end());
  }
  return image;
}

std::string bytes_of(const Image& image) {
  return {image.rgba.begin(), image.rgba.end()};
}

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

constexpr FrameSequence kTwo{.count = 2, .width = 640, .height = 480, .per_second = 24.0};

TEST(FrameFile, IsNumberedSoThatAllSortInTheirOrder) {
  EXPECT_EQ(frame_file("a/hand.png", 1, 120), "a/hand-0001.png");
  EXPECT_EQ(frame_file("hand.v2.png", 120, 120), "hand.v2-0120.png");
  EXPECT_EQ(frame_file("hand.png", 7, 12'000), "hand-00007.png");
}

TEST(OpenFrames, WritesNumberedPictures) {
  const TemporaryFolder folder;
  const auto writer = open_frames(folder / "a.png", kTwo);
  writer->write(image_of(kRedFrame));
  EXPECT_EQ(text_of(folder / "a-0001.png"), encode_png(image_of(kRedFrame))) << "whole at once";
  writer->write(image_of(kBlueFrame));
  writer->finish();
  EXPECT_EQ(text_of(folder / "a-0002.png"), encode_png(image_of(kBlueFrame)));
  EXPECT_EQ(files_in(folder.path()), 2U);
}

TEST(OpenFrames, RefusesOtherEndings) {
  EXPECT_THAT(error_message<Error>([] { open_frames("a.avi", kTwo); }),
              AllOf(HasSubstr("a.avi"), HasSubstr(".mp4"), HasSubstr(".png")));
}

TEST(OpenFrames, RefusesMorePicturesThanAllowedBeforeTheFirst) {
  const TemporaryFolder folder;
  FrameSequence many = kTwo;
  many.count = 100'001;
  EXPECT_THAT(
      error_message<Error>([&] { open_frames(folder / "a.png", many); }),
      HasSubstr("the turntable would have 100,001 pictures, more than the limit of 100,000"));
  const Environment raised("LAPWING_MOST_FRAMES", "1e6");
  EXPECT_NO_THROW(open_frames(folder / "a.png", many));
}

class AVideo : public ::testing::TestWithParam<const char*> {
 protected:
  fs::path video() const { return videos_ / (std::string("a") + GetParam()); }

  TemporaryFolder folder_;  // contains the stand-in for ffmpeg
  TemporaryFolder videos_;
};
INSTANTIATE_TEST_SUITE_P(Formats, AVideo, ::testing::Values(".mp4", ".webm", ".gif", ".MP4"),
                         [](const auto& i) {
                           return std::string(i.param + 1) == "MP4" ? "Capitals"
                                                                    : std::string(i.param + 1);
                         });

TEST_P(AVideo, HandsFfmpegEveryByteAndItsSizeAndSpeed) {
  const StandInFfmpeg ffmpeg(folder_.path());
  const auto writer = open_frames(video(), kTwo);
  writer->write(image_of(kRedFrame));
  writer->write(image_of(kBlueFrame));
  EXPECT_FALSE(fs::exists(video())) << "not before it is whole";
  writer->finish();
  EXPECT_EQ(text_of(video()), bytes_of(image_of(kRedFrame)) + bytes_of(image_of(kBlueFrame)));
  EXPECT_THAT(text_of(folder_ / "arguments"),
              AllOf(HasSubstr("-video_size\n640x480\n"), HasSubstr("-framerate\n24.000000\n"),
                    HasSubstr("-pixel_format\nrgba\n")));
  EXPECT_EQ(files_in(videos_.path()), 1U);
}

TEST_P(AVideo, ThatIsGivenUpLeavesWhatWasThere) {
  const StandInFfmpeg ffmpeg(folder_.path());
  std::ofstream(video()) << "old";
  {
    const auto writer = open_frames(video(), kTwo);
    writer->write(image_of(kRedFrame));
  }
  EXPECT_EQ(text_of(video()), "old");
  EXPECT_EQ(files_in(videos_.path()), 1U);
}

TEST_P(AVideo, ThatFfmpegCannotWriteSaysWhy) {
  std::ofstream(video()) << "old";
  // ffmpeg fails immediately or after the last image.
  for (const char* reads : {"", "cat > /dev/null; "}) {
    const StandInFfmpeg ffmpeg(folder_.path(), std::string(reads) +
                                                   "echo first >&2; echo Unknown encoder >&2; "
                                                   "exit 1");
    const std::string message = error_message<Error>([&] {
      const auto writer = open_frames(video(), kTwo);
      writer->write(image_of(kRedFrame));
      writer->write(image_of(kBlueFrame));
      writer->finish();
    });
    EXPECT_THAT(message, AllOf(HasSubstr("Unknown encoder"), HasSubstr(video().string()),
                               HasSubstr(".png"), Not(HasSubstr("first"))));
    EXPECT_EQ(text_of(video()), "old");
    EXPECT_EQ(files_in(videos_.path()), 1U);
  }
}

TEST_P(AVideo, WithoutFfmpegSaysWhatToInstall) {
  const Environment path("PATH", folder_.path().string());
  EXPECT_FALSE(can_write_videos());
  EXPECT_THAT(error_message<Error>([&] { open_frames(video(), kTwo); }),
              AllOf(HasSubstr("install the package ffmpeg"), HasSubstr(".png")));
  EXPECT_EQ(files_in(videos_.path()), 0U);
}

TEST(Mp4, ShowsWhatIsTransparentOnBlack) {
  const TemporaryFolder folder;
  const StandInFfmpeg ffmpeg(folder.path());
  const auto writer = open_frames(folder / "a.mp4", {.width = 4, .height = 2, .transparent = true});
  writer->write(image_of({255, 255, 255, 0}, 4, 2));
  writer->finish();
  EXPECT_EQ(text_of(folder / "a.mp4"), bytes_of(image_of({0, 0, 0, 255}, 4, 2)));
}

TEST(Mp4, ByFfmpegItselfHasThePicturesAndTheirColors) {
  if (!can_write_videos()) GTEST_SKIP() << "no ffmpeg on the PATH";
  const TemporaryFolder folder;
  const auto writer = open_frames(folder / "a.mp4", {.count = 6, .width = 65, .height = 49});
  for (int k = 0; k < 6; ++k) writer->write(image_of(k < 3 ? kRedFrame : kBlueFrame, 65, 49));
  writer->finish();
  const std::string decode = "ffmpeg -loglevel error -i '" + (folder / "a.mp4").string() +
                             "' -f rawvideo -pix_fmt rgb24 '" + (folder / "raw").string() + "'";
  ASSERT_EQ(std::system(decode.c_str()), 0);
  const std::string raw = text_of(folder / "raw");
  constexpr std::size_t kFrame = 64UL * 48 * 3;  // odd sizes are cropped to even ones
  ASSERT_EQ(raw.size(), 6 * kFrame);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto channel = [&](std::size_t frame) {
      return static_cast<std::uint8_t>(raw[frame * kFrame + kFrame / 2 + c]);
    };
    EXPECT_NEAR(channel(0), kRedFrame[c], 8);
    EXPECT_NEAR(channel(5), kBlueFrame[c], 8);
  }
}

}  // namespace
}  // namespace lapwing
