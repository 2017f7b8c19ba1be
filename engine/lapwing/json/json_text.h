#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing {

/// A value in the text of a JSON document: its first byte and the one behind its last.
struct JsonPlace {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Finds values in a text that `parse_json` has taken, so that one can be replaced and all other
/// bytes stay. Each call reads the value it is given once.
class JsonText {
 public:
  explicit JsonText(std::string_view text) : text_(text) {}

  std::string_view text() const { return text_; }
  JsonPlace root() const;
  /// The value of `key` in the object at `object`; nothing where it has none.
  std::optional<JsonPlace> member(JsonPlace object, std::string_view key) const;
  /// The same from the first byte of the key on.
  std::optional<JsonPlace> member_with_key(JsonPlace object, std::string_view key) const;
  /// The values of the list at `list`, in order.
  std::vector<JsonPlace> elements(JsonPlace list) const;
  /// Element `number` of the document's list `list`; both are there.
  JsonPlace element(std::string_view list, std::size_t number) const {
    return elements(*member(root(), list)).at(number);
  }

 private:
  // Key and value, with `begin` of the value in `value`.
  std::optional<JsonPlace> find_member(JsonPlace object, std::string_view key,
                                       std::size_t& value) const;
  std::size_t skip_blanks(std::size_t at) const;
  std::size_t skip_string(std::size_t at) const;
  std::size_t skip_value(std::size_t at) const;

  std::string_view text_;
};

class TextEdits;

/// Takes `key` and its value out of the object at `object`, if it has it.
void remove_member(const JsonText& text, JsonPlace object, std::string_view key, TextEdits& edits);

/// Replaces stretches of a text and leaves the rest as it is.
class TextEdits {
 public:
  void replace(JsonPlace place, std::string text) { edits_.push_back({place, std::move(text)}); }
  void insert(std::size_t at, std::string text) { replace({at, at}, std::move(text)); }
  bool empty() const { return edits_.empty(); }

  /// `text` with all of them made; what is inserted at one place stands in the order of the calls.
  std::string applied_to(std::string_view text) const;

 private:
  struct Edit {
    JsonPlace place;
    std::string text;
  };
  std::vector<Edit> edits_;
};

}  // namespace lapwing
