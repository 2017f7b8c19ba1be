#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing {

/// The byte range [begin, end) of a value in the text of a JSON document.
struct JsonPlace {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Returns the line and the column of byte `at` in `text`, such as "3:14". `first_line` is the
/// number of the first line of `text`.
std::string line_and_column(std::string_view text, std::size_t at, std::size_t first_line = 1);

/// Finds values in a text that `parse_json` has accepted, to replace them without changing other
/// bytes. Each call scans the given object or list at most once. All calls throw InputError, with
/// line and column, if a value has an unexpected type or a required member or element is missing.
class JsonText {
 public:
  /// Error messages start with `name`. `text` must outlive this object.
  JsonText(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  std::string_view text() const { return text_; }
  JsonPlace root() const;
  /// Returns the location of the value of `key` in `object`. Throws InputError if the key is
  /// missing.
  JsonPlace at(JsonPlace object, std::string_view key) const;
  /// Returns the location of the value of `key`, or nullopt if `object` does not have the key.
  std::optional<JsonPlace> find(JsonPlace object, std::string_view key) const;
  /// Returns the location of `key` and its value, or nullopt if `object` does not have the key.
  std::optional<JsonPlace> find_with_key(JsonPlace object, std::string_view key) const;
  /// Returns the locations of the values in `list`, in order.
  std::vector<JsonPlace> elements(JsonPlace list) const;
  /// Returns the location of element `number` of the list with the key `list` in the root object.
  JsonPlace element(std::string_view list, std::size_t number) const;

 private:
  struct Member {
    JsonPlace key;
    JsonPlace value;
  };
  std::optional<Member> find_member(JsonPlace object, std::string_view key) const;
  void require(JsonPlace value, char bracket, std::string_view type) const;
  [[noreturn]] void fail(JsonPlace value, const std::string& message) const;
  std::size_t skip_blanks(std::size_t at) const;
  std::size_t skip_string(std::size_t at) const;
  std::size_t skip_value(std::size_t at) const;

  std::string_view text_;
  std::string name_;
};

/// A list of replacements of ranges of a text.
class TextEdits {
 public:
  void replace(JsonPlace place, std::string text) { edits_.push_back({place, std::move(text)}); }
  void insert(std::size_t at, std::string text) { replace({at, at}, std::move(text)); }

  bool is_empty() const { return edits_.empty(); }
  /// Returns `text` with all edits. Insertions at the same position are in the order of the calls.
  std::string applied_to(std::string_view text) const;

 private:
  struct Edit {
    JsonPlace place;
    std::string text;
  };
  std::vector<Edit> edits_;
};

/// Removes `key` and its value from `object`, if it has the key.
void remove_member(const JsonText& text, JsonPlace object, std::string_view key, TextEdits& edits);

}  // namespace lapwing
