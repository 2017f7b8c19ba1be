#include "lapwing/json/json_text.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

// Returns whether the JSON string `quoted`, with its quotes, equals `key`.
bool says(std::string_view quoted, std::string_view key) {
  const std::string_view bare = quoted.substr(1, quoted.size() - 2);
  if (bare.find('\\') == std::string_view::npos) return bare == key;
  return nlohmann::json::parse(quoted).get_ref<const std::string&>() == key;
}

}  // namespace

std::string line_and_column(std::string_view text, std::size_t at, std::size_t first_line) {
  const std::string_view before = text.substr(0, std::min(at, text.size()));
  const auto line = first_line + static_cast<std::size_t>(std::ranges::count(before, '\n'));
  const std::size_t line_start = before.rfind('\n') + 1;
  return std::to_string(line) + ":" + std::to_string(before.size() - line_start + 1);
}

void JsonText::fail(JsonPlace value, const std::string& message) const {
  throw InputError(name_ + ":" + line_and_column(text_, value.begin) + ": " + message +
                   "; export the file again");
}

void JsonText::require(JsonPlace value, char bracket, std::string_view type) const {
  if (value.begin < value.end && text_[value.begin] == bracket) return;
  fail(value, "expected " + std::string(type));
}

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

std::optional<JsonText::Member> JsonText::find_member(JsonPlace object,
                                                      std::string_view key) const {
  require(object, '{', "an object");
  std::size_t at = skip_blanks(object.begin + 1);
  while (at < object.end && text_[at] == '"') {
    const JsonPlace name{at, skip_string(at)};
    const std::size_t begin = skip_blanks(skip_blanks(name.end) + 1);  // skips the colon
    const JsonPlace value{begin, skip_value(begin)};
    if (says(text_.substr(name.begin, name.end - name.begin), key)) return Member{name, value};
    at = skip_blanks(skip_blanks(value.end) + 1);  // skips the comma
  }
  return std::nullopt;
}

std::optional<JsonPlace> JsonText::find(JsonPlace object, std::string_view key) const {
  const auto member = find_member(object, key);
  if (!member) return std::nullopt;
  return member->value;
}

JsonPlace JsonText::at(JsonPlace object, std::string_view key) const {
  if (const auto value = find(object, key)) return *value;
  fail(object, "the key \"" + std::string(key) + "\" is missing");
}

std::optional<JsonPlace> JsonText::find_with_key(JsonPlace object, std::string_view key) const {
  const auto member = find_member(object, key);
  if (!member) return std::nullopt;
  return JsonPlace{member->key.begin, member->value.end};
}

void remove_member(const JsonText& text, JsonPlace object, std::string_view key, TextEdits& edits) {
  const auto place = text.find_with_key(object, key);
  if (!place) return;
  // Also remove the comma after the member or, for the last member, the comma before it.
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
  require(list, '[', "a list");
  std::vector<JsonPlace> places;
  std::size_t at = skip_blanks(list.begin + 1);
  while (at + 1 < list.end) {
    const std::size_t end = skip_value(at);
    places.push_back({at, end});
    at = skip_blanks(skip_blanks(end) + 1);
  }
  return places;
}

JsonPlace JsonText::element(std::string_view list, std::size_t number) const {
  const JsonPlace place = at(root(), list);
  const std::vector<JsonPlace> places = elements(place);
  if (number < places.size()) return places[number];
  fail(place, "element " + std::to_string(number) + " of \"" + std::string(list) +
                  "\" is missing; the list has " + std::to_string(places.size()));
}

std::string TextEdits::applied_to(std::string_view text) const {
  std::vector<const Edit*> sorted;
  for (const Edit& edit : edits_) sorted.push_back(&edit);
  const auto begin_of = [](const Edit* edit) { return edit->place.begin; };
  if (!std::ranges::is_sorted(sorted, {}, begin_of)) std::ranges::stable_sort(sorted, {}, begin_of);
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
