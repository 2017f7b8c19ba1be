#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/environment.h"

namespace lapwing::test {

/// While this object exists, $PATH contains a stand-in for the program ffmpeg. The stand-in writes
/// its arguments, one per line, to the file `arguments` in `folder`, and copies its input to its
/// output file.
class StandInFfmpeg {
 public:
  explicit StandInFfmpeg(const std::filesystem::path& folder)
      : StandInFfmpeg(folder, "printf '%s\\n' \"$@\" > '" + (folder / "arguments").string() +
                                  "'\nfor file; do :; done\ncat > \"${file#file:}\"\n") {}
  /// Creates a stand-in that runs `script`.
  StandInFfmpeg(const std::filesystem::path& folder, const std::string& script)
      : path_("PATH", (folder / "bin").string() + ":" + std::getenv("PATH")) {
    namespace fs = std::filesystem;
    fs::create_directories(folder / "bin");
    const fs::path program = folder / "bin" / "ffmpeg";
    std::ofstream(program) << "#!/bin/sh\n" << script;
    fs::permissions(program, fs::perms::owner_all);
  }

 private:
  Environment path_;
};

}  // namespace lapwing::test
