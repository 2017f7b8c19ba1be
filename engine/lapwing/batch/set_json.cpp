#include "lapwing/batch/set_json.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/json/suggest.h"

namespace lapwing {
namespace {

using Json = nlohmann::ordered_json;

// Decodes a token of a JSON pointer. Returns nothing if a ~ is not followed by 0 or 1.
std::optional<std::string> key_of(std::string_view token) {
  std::string key;
  for (std::size_t k = 0; k < token.size(); ++k) {
    if (token[k] != '~') {
      key += token[k];
      continue;
    }
    if (++k == token.size() || (token[k] != '0' && token[k] != '1')) return std::nullopt;
    key += token[k] == '0' ? '~' : '/';
  }
  return key;
}

// Returns `key` as a list index, or nothing if it is not one (RFC 6901).
std::optional<std::size_t> list_place(const std::string& key) {
  std::size_t place = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), place);
  const bool is_number = error == std::errc() && end == key.data() + key.size();
  if (!is_number || (key.size() > 1 && key[0] == '0')) return std::nullopt;
  return place;
}

// Follows a pointer through a document, token by token.
class Descent {
 public:
  Descent(const std::string& pointer, const std::string& where)
      : pointer_(pointer), where_(where) {}

  // Returns the value of `key` in `json`. The last key may create it.
  Json& step(Json& json, const std::string& key, bool is_last) {
    Json& next = json.is_object() ? member(json, key, is_last) : element(json, key, is_last);
    passed_ += "/" + key;
    return next;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(where_ + ": \"" + pointer_ + "\": " + message);
  }

 private:
  std::string here() const { return passed_.empty() ? "the recipe" : passed_; }

  Json& member(Json& json, const std::string& key, bool is_last) const {
    if (is_last) return json[key];
    if (const auto at = json.find(key); at != json.end()) return *at;
    std::vector<std::string_view> known;
    for (const auto& [name, value] : json.items()) known.emplace_back(name);
    fail(here() + " has no \"" + key + "\"; " + suggest(key, known));
  }

  Json& element(Json& json, const std::string& key, bool is_last) const {
    if (!json.is_array()) {
      fail(here() + " is neither an object nor a list; set it as a whole");
    }
    if (is_last && key == "-") return json.emplace_back();
    const std::optional<std::size_t> place = list_place(key);
    if (place && *place < json.size()) return json[*place];
    const std::string count = std::to_string(json.size());
    fail(here() + " is a list of " + count + " and has no \"" + key + "\"; use " +
         (json.empty() ? "" : "0 to " + std::to_string(json.size() - 1) + ", or ") +
         "\"-\" to append an element");
  }

  const std::string& pointer_;
  const std::string& where_;
  std::string passed_;
};

}  // namespace

void set_json(Json& document, const std::string& pointer, Json value, const std::string& where) {
  Descent descent(pointer, where);
  if (!pointer.empty() && pointer[0] != '/') {
    descent.fail("a JSON pointer begins with \"/\", as in \"/steps/0/handles/0/move/translate\"");
  }
  Json* at = &document;
  for (std::size_t begin = 1; begin <= pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
    const auto key = key_of(std::string_view(pointer).substr(begin, end - begin));
    if (!key) descent.fail("in a key, write ~ as ~0 and / as ~1");
    at = &descent.step(*at, *key, end == pointer.size());
    begin = end + 1;
  }
  *at = std::move(value);
}

}  // namespace lapwing
