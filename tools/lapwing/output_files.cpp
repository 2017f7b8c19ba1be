#include "output_files.h"

#include <CLI/CLI.hpp>

#include "lapwing/base/printable_text.h"
#include "lapwing/io/atomic_file.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/io/paths.h"

namespace lapwing::cli {

namespace fs = std::filesystem;

void OutputFiles::reads(const std::string& name, const fs::path& path, bool replaced) {
  if (!path.empty()) read_.push_back({name, split_mesh_path(path).file, replaced});
}

void OutputFiles::writes(const std::string& name, const fs::path& path) {
  add(name, path, false);
}

void OutputFiles::writes_mesh(const std::string& name, const fs::path& path) {
  if (!path.empty()) static_cast<void>(format_of(path));
  add(name, path, true);
}

void OutputFiles::writes_picture(const std::string& name, const fs::path& path) {
  const std::string ending = path.extension().string();
  if (!path.empty() && ending != ".png" && ending != ".PNG") {
    throw CLI::ValidationError(
        name, printable(path.string() + " is not named as a PNG picture; end its name in .png"));
  }
  add(name, path, false);
}

void OutputFiles::add(const std::string& name, const fs::path& path, bool is_mesh) {
  if (path.empty()) return;
  const auto refuse = [&](const std::string& why) {
    throw CLI::ValidationError(name,
                               printable(path.string() + " is " + why + "; name another file"));
  };
  for (const File& other : read_) {
    if (is_mesh && other.is_replaceable) continue;
    if (is_same_file(other.path, path)) refuse("also read as " + other.name);
  }
  for (const File& other : written_) {
    if (is_same_file(other.path, path)) refuse("also written as " + other.name);
  }
  require_replaceable(path);
  written_.push_back({name, path, false});
}

}  // namespace lapwing::cli
