#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/environment.h"

namespace lapwing::test {

/// A program called ffmpeg that goes before any other, until this goes: it writes its arguments,
/// one a line, to `arguments` of `folder`, and what it reads, as it is, to the file it is to make.
class StandInFfmpeg {
 public:
  explicit StandInFfmpeg(const std::filesystem::path& folder)
      : StandInFfmpeg(folder, "printf '%s\\n' \"$@\" > '" + (folder / "arguments").string() +
                                  "'\nfor file; do :; done\ncat > \"${file#file:}\"\n") {}
  /// Or one that does what `script` says.
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
