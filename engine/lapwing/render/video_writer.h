#pragma once

#include <cstdio>
#include <optional>
#include <string_view>
#include <sys/types.h>

#include "lapwing/io/atomic_file.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/render/frame_writer.h"

namespace lapwing {

enum class VideoFormat { mp4, webm, gif };

/// Returns the format of the file name extension `ending`, such as ".mp4".
std::optional<VideoFormat> video_format_of(std::string_view ending);

/// Returns the path of the program ffmpeg if it is on $PATH.
std::optional<std::filesystem::path> find_ffmpeg();
/// Returns the path of ffmpeg for writing the video `output`. If there is none, throws IoError,
/// which tells the user what to do.
std::filesystem::path require_ffmpeg(const std::filesystem::path& output);

/// Sends frames to an ffmpeg process, which encodes each frame when it arrives. ffmpeg writes a
/// temporary file in the folder of `output`. When the file is complete, it replaces `output`.
class VideoWriter final : public FrameWriter {
 public:
  /// Throws IoError if ffmpeg cannot be started or the file cannot be created.
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
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> errors_;  // error output of ffmpeg
  FileDescriptor frames_{-1};                               // input of ffmpeg
  pid_t process_ = -1;                                      // -1 after it has ended
};

}  // namespace lapwing
