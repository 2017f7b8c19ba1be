#include "lapwing/recipe/parse_json.h"

#include <algorithm>
#include <set>
#include <vector>

#include "lapwing/base/errors.h"

namespace lapwing {

using Json = nlohmann::ordered_json;

namespace {

std::string line_and_column(std::string_view text, std::size_t byte, std::size_t first_line) {
  const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
  const auto line =
      first_line + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t line_start = before.rfind('\n') + 1;
  return std::to_string(line) + ":" + std::to_string(before.size() - line_start + 1);
}

// The library's message without its own prefix of class, number and position.
std::string bare_message(const Json::exception& error) {
  const std::string_view text = error.what();
  const std::size_t at = text.find("syntax error");
  return std::string(at == std::string_view::npos ? text : text.substr(at));
}

}  // namespace

Json parse_json(std::string_view text, const std::string& name, std::size_t first_line) {
  std::vector<std::set<std::string>> keys;
  const auto refuse_repeated_keys = [&](int, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key) {
      const auto& key = parsed.get_ref<const std::string&>();
      if (!keys.back().insert(key).second) {
        throw InputError(name + ": the key \"" + key +
                         "\" stands twice in one object; remove one of the two");
      }
    }
    return true;
  };
  try {
    return Json::parse(text, refuse_repeated_keys);
  } catch (const Json::parse_error& error) {
    throw InputError(name + ":" + line_and_column(text, error.byte, first_line) + ": " +
                     bare_message(error) + "; check commas, quotes and brackets before this place");
  } catch (const Json::exception& error) {
    throw InputError(name + ": " + bare_message(error));
  }
}

std::string pointer_token(std::string_view key) {
  std::string token;
  for (const char c : key) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += c;
    }
  }
  return token;
}

}  // namespace lapwing
