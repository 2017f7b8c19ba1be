#include "lapwing/io/real_path.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // the kernel's limit

}  // namespace

fs::path real_path(const fs::path& path) {
  fs::path at = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(at, error)); ++links) {
    if (links == kMostLinks) {
      throw IoError("cannot follow " + path.string() + ": " + std::strerror(ELOOP) +
                    "; name another file");
    }
    const fs::path next = fs::read_symlink(at, error);
    if (error) break;
    at = at.parent_path() / next;
  }
  const fs::path whole = fs::absolute(at);
  const fs::path folder = fs::weakly_canonical(whole.parent_path(), error);
  return ((error ? whole.parent_path() : folder) / whole.filename()).lexically_normal();
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  return real_path(a) == real_path(b);
}

bool is_inside(const fs::path& path, const fs::path& folder) {
  const fs::path inner = real_path(path);
  const fs::path outer = real_path(folder / ".").parent_path();
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

}  // namespace lapwing
