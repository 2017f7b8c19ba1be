#include "preferences/preferences.h"

#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/io/atomic_file.h"
#include "state/user_folder.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// The valid range of a preference. Values outside it are rejected, so that the window is usable.
struct Range {
  double least;
  double most;
};
constexpr Range kSidebarLetters{16.0, 80.0};
constexpr Range kWindowUnits{320.0, 16384.0};
constexpr Range kBrushPt{1.0, 500.0};

// Calls `visit` with every preference and its key in the file.
template <typename P, typename Visit>
void keys_of(P& preferences, const Visit& visit) {
  visit("theme", preferences.theme);
  visit("mouse", preferences.mouse);
  visit("unit", preferences.unit);
  visit("guide", preferences.shows_guide);
  visit("settle_while_dragging", preferences.settles_while_dragging);
  visit("system_dialogs", preferences.uses_system_dialogs);
  visit("sidebar_letters", preferences.sidebar_letters, kSidebarLetters);
  visit("window_width", preferences.window_width, kWindowUnits);
  visit("window_height", preferences.window_height, kWindowUnits);
  visit("tool", preferences.tool);
  visit("brush_radius", preferences.brush_radius_pt, kBrushPt);
  visit("grab_radius", preferences.grab_radius_pt, kBrushPt);
}

Json json_of(Theme theme) {
  return theme == Theme::light ? "light" : "dark";
}
template <typename Value>
Json json_of(const Value& value) {
  return value;
}

// Reads a value. Returns false if `json` has another type or the value is out of range.
bool take(const Json& json, Theme& theme) {
  if (json != "light" && json != "dark") return false;
  theme = json == "light" ? Theme::light : Theme::dark;
  return true;
}
template <typename Value>
bool take(const Json& json, Value& value) {
  if (json.type() != Json(value).type()) return false;
  value = json.get<Value>();
  return true;
}
template <typename Number>
bool take(const Json& json, Number& number, const Range& range) {
  if (!json.is_number()) return false;
  const double value = json.get<double>();
  if (!(value >= range.least && value <= range.most)) return false;
  number = static_cast<Number>(value);
  return true;
}

// Returns the contents of the file. Returns nullopt if the file cannot be opened, and a discarded
// JSON value if its contents are not JSON.
std::optional<Json> parsed(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return Json::parse(text, nullptr, false);
}

}  // namespace

fs::path preferences_file() {
  return user_folder("XDG_CONFIG_HOME", ".config") / "viewer.json";
}

ReadPreferences read_preferences(const fs::path& file) {
  ReadPreferences read;
  const std::optional<Json> json = parsed(file);
  if (!json) return read;
  if (!json->is_object()) {
    read.troubles.push_back(
        file.string() +
        " is damaged. The defaults are used, and the file is replaced when a preference changes.");
    return read;
  }
  keys_of(read.preferences, [&](const char* name, auto& value, const auto&... range) {
    const auto found = json->find(name);
    if (found == json->end() || take(*found, value, range...)) return;
    read.troubles.push_back(file.string() + ": \"" + name + "\" cannot be " + found->dump() +
                            ". The default is used.");
  });
  return read;
}

void write_preferences(const Preferences& preferences, const fs::path& file) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) {
    throw IoError("Cannot save the preferences in " + file.string() + ": " + error.message() +
                  ". Set XDG_CONFIG_HOME to a writable folder.");
  }
  Json json = parsed(file).value_or(Json::object());
  if (!json.is_object()) json = Json::object();
  keys_of(preferences, [&](const char* name, const auto& value, const auto&...) {
    json[name] = json_of(value);
  });
  replace_file(file, json.dump(2) + "\n");
}

}  // namespace lapwing::viewer
