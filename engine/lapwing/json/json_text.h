#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing {

/// The place of a value in the text of a JSON document: its first byte, and the one after its last.
struct JsonPlace {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Finds values in a text that `parse_json` has accepted, so that one can be replaced while all
/// other bytes stay. Each call scans the given value once.
class JsonText {
 public:
  explicit JsonText(std::string_view text) : text_(text) {}

  std::string_view text() const { return text_; }
  JsonPlace root() const;
  /// Returns the place of the value of `key` in `object`, or nothing if it has no such key.
  std::optional<JsonPlace> member(JsonPlace object, std::string_view key) const;
  /// The same, starting at the first byte of the key.
  std::optional<JsonPlace> member_with_key(JsonPlace object, std::string_view key) const;
  /// Returns the places of the values in `list`, in order.
  std::vector<JsonPlace> elements(JsonPlace list) const;
  /// Returns element `number` of the list `list` of the document's root. Both must exist.
  JsonPlace element(std::string_view list, std::size_t number) const {
    return elements(*member(root(), list)).at(number);
  }

 private:
  // Returns the place of key and value, and sets `value` to the beginning of the value.
  std::optional<JsonPlace> find_member(JsonPlace object, std::string_view key,
                                       std::size_t& value) const;
  std::size_t skip_blanks(std::size_t at) const;
  std::size_t skip_string(std::size_t at) const;
  std::size_t skip_value(std::size_t at) const;

  std::string_view text_;
};

class TextEdits;

/// Removes `key` and its value from `object`, if it has the key.
void remove_member(const JsonText& text, JsonPlace object, std::string_view key, TextEdits& edits);

/// Replaces ranges of a text and keeps the rest.
class TextEdits {
 public:
  void replace(JsonPlace place, std::string text) { edits_.push_back({place, std::move(text)}); }
  void insert(std::size_t at, std::string text) { replace({at, at}, std::move(text)); }
  bool empty() const { return edits_.empty(); }

  /// Returns `text` with all edits. Insertions at one place keep the order of the calls.
  std::string applied_to(std::string_view text) const;

 private:
  struct Edit {
    JsonPlace place;
    std::string text;
  };
  std::vector<Edit> edits_;
};

}  // namespace lapwing
