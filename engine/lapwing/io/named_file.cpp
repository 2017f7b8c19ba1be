#include "lapwing/io/named_file.h"

#include <algorithm>
#include <string>
#include <system_error>

namespace lapwing {
namespace {

namespace fs = std::filesystem;

bool is_same_letter(char a, char b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return lower(a) == lower(b);
}

// Returns the entry `name` of `folder`, else the first by name that differs only in case.
std::optional<fs::path> find_entry(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  std::optional<fs::path> found;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end;
       at.increment(error)) {
    const std::string other = at->path().filename().string();
    if (!std::ranges::equal(name, other, is_same_letter)) continue;
    if (!found || other < found->filename().string()) found = folder / other;
  }
  return found;
}

bool leaves_its_folder(const fs::path& name) {
  const bool has_drive = name.native().size() > 1 && name.native()[1] == ':';
  return name.is_absolute() || has_drive ||
         std::any_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
}

std::optional<fs::path> find_below(const fs::path& folder, const fs::path& name) {
  fs::path at = folder;
  for (const fs::path& part : name) {
    if (part == "." || part.empty()) continue;
    const auto entry = find_entry(at, part.string());
    if (!entry) return {};
    at = *entry;
  }
  std::error_code error;
  if (!fs::is_regular_file(at, error)) return {};
  return at;
}

}  // namespace

std::optional<fs::path> find_named_file(const fs::path& folder, std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '\\', '/');
  const fs::path path(text);
  if (!leaves_its_folder(path)) {
    if (auto found = find_below(folder, path)) return found;
  }
  const fs::path last = path.filename();
  if (last.empty() || last == "." || last == "..") return {};
  return find_below(folder, last);
}

}  // namespace lapwing
