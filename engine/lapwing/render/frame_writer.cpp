#include "lapwing/render/frame_writer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "lapwing/base/errors.h"
#include "lapwing/base/limits.h"
#include "lapwing/render/video_writer.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

// With leading zeros, file browsers sort the images correctly.
constexpr std::size_t kFewestDigits = 4;

std::string ending_of(const fs::path& output) {
  std::string ending = output.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

class NumberedImages final : public FrameWriter {
 public:
  NumberedImages(fs::path output, int count) : output_(std::move(output)), count_(count) {}

  void write(const Image& frame) override {
    write_png(frame_file(output_, ++written_, count_), frame);
  }
  void finish() override {}

 private:
  fs::path output_;
  int count_;
  int written_ = 0;
};

}  // namespace

bool is_video(const fs::path& output) {
  return video_format_of(ending_of(output)).has_value();
}

bool can_write_videos() {
  return find_ffmpeg().has_value();
}

fs::path frame_file(const fs::path& output, int number, int count) {
  std::string digits = std::to_string(number);
  const std::size_t width = std::max(kFewestDigits, std::to_string(count).size());
  digits.insert(0, width - std::min(width, digits.size()), '0');
  return output.parent_path() /
         (output.stem().string() + "-" + digits + output.extension().string());
}

void check_frames_name(const fs::path& output) {
  if (is_video(output)) {
    require_ffmpeg(output);
  } else if (ending_of(output) != ".png") {
    throw InputError(output.string() +
                     ": end the name in .png for numbered pictures, or in .mp4, .webm or .gif for "
                     "a video");
  }
}

std::unique_ptr<FrameWriter> open_frames(const fs::path& output, const FrameSequence& sequence) {
  check_frames_name(output);
  require_at_most(kMostFrames, sequence.count, "the turntable would have",
                  "ask for fewer pictures");
  if (const auto format = video_format_of(ending_of(output))) {
    return std::make_unique<VideoWriter>(output, *format, sequence);
  }
  return std::make_unique<NumberedImages>(output, sequence.count);
}

}  // namespace lapwing
