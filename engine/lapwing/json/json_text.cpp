#include "lapwing/json/json_text.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace lapwing {
namespace {

// Returns whether the string `quoted`, with its quotes, equals `key`.
bool says(std::string_view quoted, std::string_view key) {
  const std::string_view bare = quoted.substr(1, quoted.size() - 2);
  if (bare.find('\\') == std::string_view::npos) return bare == key;
  return nlohmann::json::parse(quoted).get_ref<const std::string&>() == key;
}

}  // namespace

std::size_t JsonText::skip_blanks(std::size_t at) const {
  return std::min(text_.find_first_not_of(" \t\r\n", at), text_.size());
}

std::size_t JsonText::skip_string(std::size_t at) const {
  for (++at; at < text_.size() && text_[at] != '"'; ++at) {
    if (text_[at] == '\\') ++at;
  }
  return std::min(at + 1, text_.size());
}

std::size_t JsonText::skip_value(std::size_t at) const {
  if (at >= text_.size()) return at;
  if (text_[at] == '"') return skip_string(at);
  if (text_[at] != '{' && text_[at] != '[') {
    return std::min(text_.find_first_of(",]} \t\r\n", at), text_.size());
  }
  std::size_t depth = 0;
  while (at < text_.size()) {
    const char c = text_[at];
    if (c == '"') {
      at = skip_string(at);
      continue;
    }
    ++at;
    if (c == '{' || c == '[') ++depth;
    if ((c == '}' || c == ']') && --depth == 0) break;
  }
  return at;
}

JsonPlace JsonText::root() const {
  // parse_json accepts a byte-order mark before the document.
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  const std::size_t begin = skip_blanks(text_.starts_with(kByteOrderMark) ? 3 : 0);
  return {begin, skip_value(begin)};
}

std::optional<JsonPlace> JsonText::find_member(JsonPlace object, std::string_view key,
                                               std::size_t& value) const {
  std::size_t at = skip_blanks(object.begin + 1);
  while (at < object.end && text_[at] == '"') {
    const std::size_t key_end = skip_string(at);
    const bool is_it = says(text_.substr(at, key_end - at), key);
    const std::size_t begin = skip_blanks(skip_blanks(key_end) + 1);  // after the colon
    const std::size_t end = skip_value(begin);
    if (is_it) {
      value = begin;
      return JsonPlace{at, end};
    }
    at = skip_blanks(skip_blanks(end) + 1);  // after the comma
  }
  return std::nullopt;
}

std::optional<JsonPlace> JsonText::member(JsonPlace object, std::string_view key) const {
  std::size_t value = 0;
  const auto found = find_member(object, key, value);
  if (!found) return std::nullopt;
  return JsonPlace{value, found->end};
}

std::optional<JsonPlace> JsonText::member_with_key(JsonPlace object, std::string_view key) const {
  std::size_t value = 0;
  return find_member(object, key, value);
}

void remove_member(const JsonText& text, JsonPlace object, std::string_view key, TextEdits& edits) {
  const auto place = text.member_with_key(object, key);
  if (!place) return;
  // Remove the comma after the member, or the one before it if it is the last.
  std::size_t begin = place->begin;
  std::size_t end = place->end;
  const std::size_t next = text.text().find_first_not_of(" \t\r\n", end);
  if (next != std::string_view::npos && text.text()[next] == ',') {
    end = next + 1;
  } else {
    const std::size_t before = text.text().find_last_not_of(" \t\r\n", begin - 1);
    if (text.text()[before] == ',') begin = before;
  }
  edits.replace({begin, end}, "");
}

std::vector<JsonPlace> JsonText::elements(JsonPlace list) const {
  std::vector<JsonPlace> places;
  std::size_t at = skip_blanks(list.begin + 1);
  while (at + 1 < list.end) {
    const std::size_t end = skip_value(at);
    places.push_back({at, end});
    at = skip_blanks(skip_blanks(end) + 1);
  }
  return places;
}

std::string TextEdits::applied_to(std::string_view text) const {
  std::vector<const Edit*> sorted;
  for (const Edit& edit : edits_) sorted.push_back(&edit);
  std::ranges::stable_sort(sorted, {}, [](const Edit* edit) { return edit->place.begin; });
  std::string result;
  std::size_t copied = 0;
  for (const Edit* edit : sorted) {
    result.append(text, copied, edit->place.begin - copied);
    result += edit->text;
    copied = edit->place.end;
  }
  result.append(text, copied);
  return result;
}

}  // namespace lapwing
