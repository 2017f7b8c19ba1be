#pragma once

#include <cstdio>
#include <optional>
#include <string_view>
#include <sys/types.h>

#include "lapwing/io/atomic_file.h"
#include "lapwing/io/file_descriptor.h"
#include "lapwing/render/frame_writer.h"

namespace lapwing {

enum class VideoFormat { mp4, webm, gif };

/// By the ending of a name: ".mp4".
std::optional<VideoFormat> video_format_of(std::string_view ending);

/// The program of that name on $PATH, if there is one.
std::optional<std::filesystem::path> find_ffmpeg();
/// Likewise for the video `output`. Throws IoError where there is none, which says what to do.
std::filesystem::path require_ffmpeg(const std::filesystem::path& output);

/// Hands frames to ffmpeg, a process of its own that reads them as they come, and writes into a
/// temporary beside the video until that is whole.
class VideoWriter final : public FrameWriter {
 public:
  /// Throws IoError where ffmpeg cannot be started or the file not be made.
  VideoWriter(const std::filesystem::path& output, VideoFormat format,
              const FrameSequence& sequence);
  ~VideoWriter() override;
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  void write(const Image& frame) override;
  void finish() override;

 private:
  [[noreturn]] void fail();
  int wait_for_end();

  std::filesystem::path output_;
  bool puts_on_black_;
  FileReplacement replacement_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> errors_;  // what ffmpeg says
  FileDescriptor frames_{-1};                               // what ffmpeg reads
  pid_t process_ = -1;                                      // none any more once it has ended
};

}  // namespace lapwing
