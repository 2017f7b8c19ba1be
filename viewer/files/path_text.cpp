#include "files/path_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

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

// Returns the names in `folder` that start with `begin`. Names of folders end in a slash.
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

// Returns the longest common prefix. Ignores case; the result has the case of the first name.
std::string common_beginning(const std::vector<std::string>& names) {
  std::string common = names.front();
  for (const std::string& name : names) {
    const auto [mine, other] =
        std::mismatch(common.begin(), common.end(), name.begin(), name.end(),
                      [](char a, char b) { return lower_case(a) == lower_case(b); });
    common.erase(mine, common.end());
  }
  // Do not split a multi-byte UTF-8 character.
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
  // Remove a trailing slash: "models/" is the same folder as "models".
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

std::string date_in_words(std::filesystem::file_time_type time) {
  const auto system = std::chrono::file_clock::to_sys(time);
  const std::time_t seconds = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::system_clock::duration>(system));
  std::tm local{};
  localtime_r(&seconds, &local);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", &local);
  return text.data();
}

std::string size_in_words(std::uint64_t bytes) {
  constexpr std::array<const char*, 5> kUnits{"B", "KB", "MB", "GB", "TB"};
  auto size = static_cast<double>(bytes);
  std::size_t unit = 0;
  // A size that would be rounded to 1000 is written in the next larger unit.
  while (size >= 999.5 && unit + 1 < kUnits.size()) {
    size /= 1000.0;
    ++unit;
  }
  std::array<char, 32> text{};
  const int digits = unit > 0 && size < 9.95 ? 1 : 0;
  std::snprintf(text.data(), text.size(), "%.*f %s", digits, size, kUnits[unit]);
  return text.data();
}

char lower_case(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) { return lower_case(c); });
  return text;
}

}  // namespace lapwing::viewer
