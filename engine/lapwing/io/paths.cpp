#include "lapwing/io/paths.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/io/text_scanner.h"

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

namespace {

namespace fs = std::filesystem;

// Returns the entry `name` of `folder`, else the first by name that differs only in case.
std::optional<fs::path> find_entry(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  std::optional<fs::path> found;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end;
       at.increment(error)) {
    const std::string other = at->path().filename().string();
    if (lowered(name) != lowered(other)) continue;
    if (!found || other < found->filename().string()) found = folder / other;
  }
  return found;
}

// Splits a path from any operating system into its components. Omits the drive, and all components
// up to the last "..".
std::vector<std::string> named_parts(std::string_view name) {
  if (name.size() > 1 && name[1] == ':') name.remove_prefix(2);
  std::vector<std::string> parts;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find_first_of("/\\"), name.size());
    const std::string_view part = name.substr(0, end);
    name.remove_prefix(std::min(end + 1, name.size()));
    if (part == "..") {
      parts.clear();
    } else if (!part.empty() && part != ".") {
      parts.emplace_back(part);
    }
  }
  return parts;
}

// Returns the regular file below `folder` whose path has the components `parts`, or nullopt if it
// does not exist.
std::optional<fs::path> find_below(const fs::path& folder, std::span<const std::string> parts) {
  fs::path at = folder;
  for (const std::string& part : parts) {
    const auto entry = find_entry(at, part);
    if (!entry) return {};
    at = *entry;
  }
  std::error_code error;
  if (!fs::is_regular_file(at, error)) return {};
  return at;
}

}  // namespace

std::optional<fs::path> find_named_file(const fs::path& folder, std::string_view name) {
  constexpr std::size_t kMostParts = 32;  // limits the search time for untrusted names
  const std::vector<std::string> parts = named_parts(name);
  for (std::size_t count = std::min(parts.size(), kMostParts); count > 0; --count) {
    if (auto found = find_below(folder, std::span(parts).last(count))) return found;
  }
  return {};
}

}  // namespace lapwing
