#include "lapwing/render/video_writer.h"

#include <array>
#include <cerrno>
#include <signal.h>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/io/child_process.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

struct FormatWords {
  std::string_view ending;
  std::string_view muxer;  // ffmpeg's name
};
// In the order of VideoFormat.
constexpr std::array<FormatWords, 3> kFormats{
    {{".mp4", "mp4"}, {".webm", "webm"}, {".gif", "gif"}}};

// Constant rate factors (-crf) of H.264 and VP9 that are visually lossless.
constexpr const char* kQualityOfMp4 = "18";
constexpr const char* kQualityOfWebm = "24";
// Encoder speed, from 0 to 5. Value 4 halves the time of the default and makes the file 10 %
// larger.
constexpr const char* kHasteOfWebm = "4";

// One palette for the whole sequence, although ffmpeg must store all frames for it. With one
// palette per frame, the video would flicker and be more than 50 % larger.
constexpr const char* kPalette = "split[a][b];[a]palettegen[p];[b][p]paletteuse";
// Players assume Rec. 709 for videos of current sizes.
constexpr const char* kRec709 = "scale=out_color_matrix=bt709:out_range=tv";
// Chroma has half the resolution, so width and height must be even. Crops at most one row and one
// column.
constexpr const char* kEven = "crop=trunc(iw/2)*2:trunc(ih/2)*2,";

void append(std::vector<std::string>& to, std::initializer_list<std::string> more) {
  to.insert(to.end(), more);
}

std::vector<std::string> ffmpeg_command(const fs::path& program, const fs::path& file,
                                        VideoFormat format, const FrameSequence& sequence) {
  const std::string size = std::to_string(sequence.width) + "x" + std::to_string(sequence.height);
  std::vector<std::string> command{program.string(), "-hide_banner", "-loglevel", "error", "-y"};
  append(command, {"-f", "rawvideo", "-pixel_format", "rgba", "-video_size", size, "-framerate",
                   std::to_string(sequence.per_second), "-i", "pipe:0"});
  const std::string rec709 = std::string(kRec709) + ",format=";
  const std::initializer_list<std::string> tags{"-colorspace", "bt709", "-color_primaries", "bt709",
                                                "-color_trc",  "bt709", "-color_range",     "tv"};
  switch (format) {
    case VideoFormat::mp4:
      append(command,
             {"-vf", kEven + rec709 + "yuv420p", "-crf", kQualityOfMp4, "-movflags", "+faststart"});
      append(command, tags);
      break;
    case VideoFormat::webm:
      append(command, {"-vf", rec709 + (sequence.transparent ? "yuva420p" : "yuv420p"), "-crf",
                       kQualityOfWebm, "-b:v", "0", "-cpu-used", kHasteOfWebm, "-row-mt", "1"});
      append(command, tags);
      break;
    case VideoFormat::gif:
      append(command, {"-vf", kPalette});
      break;
  }
  const FormatWords& words = kFormats[static_cast<std::size_t>(format)];
  append(command, {"-f", std::string(words.muxer), "file:" + file.string()});
  return command;
}

}  // namespace

std::optional<VideoFormat> video_format_of(std::string_view ending) {
  for (std::size_t k = 0; k < kFormats.size(); ++k) {
    if (kFormats[k].ending == ending) return static_cast<VideoFormat>(k);
  }
  return {};
}

std::optional<fs::path> find_ffmpeg() {
  return find_program("ffmpeg");
}

fs::path require_ffmpeg(const fs::path& output) {
  auto program = find_ffmpeg();
  if (!program) {
    throw IoError(output.string() +
                  ": writing a video needs the program ffmpeg, which is not on the PATH; install "
                  "the package ffmpeg, or end the name in .png for numbered pictures");
  }
  return *std::move(program);
}

VideoWriter::VideoWriter(const fs::path& output, VideoFormat format, const FrameSequence& sequence)
    : output_(output),
      puts_on_black_(sequence.transparent && format == VideoFormat::mp4),
      replacement_(output),
      errors_(std::tmpfile(), &std::fclose) {
  const fs::path program = require_ffmpeg(output);
  // Use a socket instead of a pipe: if ffmpeg has ended, writing returns an error instead of
  // raising a signal.
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw IoError("cannot open a socket: " + std::generic_category().message(errno) +
                  "; close other programs");
  }
  frames_.reset(ends[0]);
  const FileDescriptor child_end(ends[1]);
  if (errors_ == nullptr) {
    throw IoError("cannot create a temporary file: " + std::generic_category().message(errno) +
                  "; free some space in the folder of temporary files");
  }
  try {
    process_ = start_child(ffmpeg_command(program, replacement_.temporary(), format, sequence),
                           {.input = ends[1], .errors = fileno(errors_.get())});
  } catch (const IoError& error) {
    throw IoError(std::string(error.what()) + "; end the name in .png for numbered pictures");
  }
}

VideoWriter::~VideoWriter() {
  if (process_ <= 0) return;
  kill(-process_, SIGKILL);
  wait_for_end();
}

void VideoWriter::write(const Image& frame) {
  std::optional<Image> opaque;
  if (puts_on_black_) composite_over_black(opaque.emplace(frame));
  const std::vector<std::uint8_t>& bytes = opaque ? opaque->rgba : frame.rgba;
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t put = send(frames_.get(), bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) fail();
    done += static_cast<std::size_t>(put);
  }
}

void VideoWriter::finish() {
  frames_.close();
  if (wait_for_end() != 0) fail();
  replacement_.commit();
}

int VideoWriter::wait_for_end() {
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

// Throws IoError with the last line of ffmpeg's error output as the reason.
void VideoWriter::fail() {
  frames_.close();
  if (process_ > 0) wait_for_end();
  std::rewind(errors_.get());
  std::array<char, 1024> line{};
  std::string last = "it ended before the last picture";
  while (std::fgets(line.data(), line.size(), errors_.get()) != nullptr) {
    std::string_view words(line.data());
    while (words.ends_with('\n')) words.remove_suffix(1);
    if (!words.empty()) last = words;
  }
  throw IoError("ffmpeg cannot write " + output_.string() + ": " + last +
                "; nothing was changed. End the name in .png for numbered pictures");
}

}  // namespace lapwing
