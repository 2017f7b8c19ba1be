#include "fuzz/targets.h"

#include <algorithm>
#include <cstdio>
#include <fcntl.h>
#include <stdexcept>
#include <unistd.h>

namespace lapwing::fuzz {
namespace {

namespace fs = std::filesystem;

// A temporary folder of this process, on an in-memory file system if there is one.
class Folder {
 public:
  Folder() {
    const fs::path shared = "/dev/shm";
    std::error_code error;
    const fs::path place = fs::is_directory(shared, error) ? shared : fs::temp_directory_path();
    std::string name = (place / "lapwing-fuzz-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

std::span<const Target> targets() {
  static const std::vector<Target> kAll = [] {
    std::vector<Target> all;
    for (const auto some : {file_targets(), recipe_targets(), operation_targets()}) {
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }();
  return kAll;
}

const Target& target_named(std::string_view name) {
  const auto all = targets();
  const auto at = std::ranges::find(all, name, &Target::name);
  if (at == all.end()) throw std::invalid_argument("no target " + std::string(name));
  return *at;
}

void require(bool holds, std::string_view what) {
  if (!holds) throw Violation{std::string(what)};
}

std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

fs::path file_of(std::string_view text, std::string_view name) {
  static const Folder folder;
  const fs::path path = folder.path() / name;
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  const bool written =
      file >= 0 && ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (file < 0 || ::close(file) != 0 || !written) {
    throw std::runtime_error("cannot write " + path.string());
  }
  return path;
}

fs::path file_of(Bytes bytes, std::string_view name) {
  return file_of(text_of(bytes), name);
}

}  // namespace lapwing::fuzz
