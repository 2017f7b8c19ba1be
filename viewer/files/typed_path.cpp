#include "files/typed_path.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "files/letters.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

bool begins(std::string_view name, std::string_view with, bool any_case) {
  if (name.size() < with.size()) return false;
  return std::equal(with.begin(), with.end(), name.begin(), [&](char a, char b) {
    return any_case ? lower_case(a) == lower_case(b) : a == b;
  });
}

// Returns the names in `folder` that start with `begin`; folders end in a slash.
std::vector<std::string> names_in(const fs::path& folder, std::string_view begin, bool any_case) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::string name = entry->path().filename().string();
    const bool hidden = name.starts_with('.') && !begin.starts_with('.');
    if (hidden || !begins(name, begin, any_case)) continue;
    std::error_code unknown;
    if (entry->is_directory(unknown)) name += '/';
    names.push_back(std::move(name));
  }
  return names;
}

// Returns the common prefix, in the case of the first name.
std::string common_beginning(const std::vector<std::string>& names) {
  std::string common = names.front();
  for (const std::string& name : names) {
    const auto [mine, other] =
        std::mismatch(common.begin(), common.end(), name.begin(), name.end(),
                      [](char a, char b) { return lower_case(a) == lower_case(b); });
    common.erase(mine, common.end());
  }
  // Do not cut a UTF-8 character of several bytes.
  const auto is_inside = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  const std::string& name = names.front();
  while (!common.empty() && common.size() < name.size() && is_inside(name[common.size()])) {
    common.pop_back();
  }
  return common;
}

}  // namespace

fs::path home_folder() {
  const char* home = std::getenv("HOME");
  return home != nullptr && *home == '/' ? fs::path(home).lexically_normal() : fs::path();
}

std::string with_tilde(const fs::path& path) {
  const fs::path home = home_folder();
  if (home.empty()) return path.string();
  const fs::path relative = path.lexically_relative(home);
  if (relative.empty() || *relative.begin() == "..") return path.string();
  return relative == "." ? "~" : (fs::path("~") / relative).string();
}

fs::path path_of(std::string_view typed, const fs::path& folder) {
  typed = trimmed(typed);
  const fs::path home = home_folder();
  fs::path path(typed);
  if (!home.empty() && (typed == "~" || typed.starts_with("~/"))) {
    path = home / fs::path(typed.substr(std::min<std::size_t>(2, typed.size())));
  }
  path = (folder / path).lexically_normal();
  // "models/" and "models" are one folder.
  if (!path.has_filename() && path != path.root_path()) path = path.parent_path();
  return path;
}

std::string completed(std::string_view typed, const fs::path& folder) {
  if (typed == "~" && !home_folder().empty()) return "~/";
  const auto slash = typed.rfind('/');
  const std::string_view before =
      slash == std::string_view::npos ? std::string_view() : typed.substr(0, slash + 1);
  const std::string_view begin = typed.substr(before.size());
  const fs::path where = before.empty() ? folder : path_of(before, folder);
  std::vector<std::string> names = names_in(where, begin, false);
  if (names.empty()) names = names_in(where, begin, true);
  if (names.empty()) return std::string(typed);
  const std::string common = common_beginning(names);
  return common.size() < begin.size() ? std::string(typed) : std::string(before) + common;
}

}  // namespace lapwing::viewer
