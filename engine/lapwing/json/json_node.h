#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A value in a JSON document with its location. Every accessor checks the type, and throws
/// InputError "NAME: /json/pointer: expected ..., got ..." if it is wrong. Copies are cheap and
/// share ownership of the document.
class JsonNode {
 public:
  /// Returns the root of `text`. Throws InputError with line and column if it is not JSON or if an
  /// object has a key twice.
  static JsonNode parse(std::string_view text, const std::string& name);
  /// Returns the root of a document that was not read from text (parse_json.h).
  struct Document;
  static JsonNode of(Document document, const std::string& name);

  /// Returns the prefix of messages: the name of the document and the JSON pointer.
  const std::string& where() const { return where_; }
  /// Returns the prefix of messages for the value at `pointer`, which is relative to this value and
  /// has no leading slash.
  std::string where(std::string_view pointer) const;
  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_expecting(const std::string& what) const;

  /// Throws InputError unless this is an object whose keys are all in `known`. The message suggests
  /// the nearest key.
  void require_keys(const std::vector<std::string_view>& known) const;
  std::vector<std::string> keys() const;  ///< keys of this object, sorted
  bool has(std::string_view key) const;
  JsonNode at(std::string_view key) const;
  std::optional<JsonNode> find(std::string_view key) const;
  /// Returns the key of this object that is in `keys`. Throws InputError about `what` if there are
  /// none or several.
  std::string_view only_key_of(const std::vector<std::string_view>& keys,
                               const std::string& what) const;

  /// Returns the index of this string in `names`. If it is not there, throws InputError "unknown
  /// WHAT ..." with the nearest name.
  std::size_t one_of(const std::string& what, const std::vector<std::string_view>& names) const;

  std::vector<JsonNode> elements() const;
  /// Returns element `k` of this list, or nothing if the list is shorter.
  std::optional<JsonNode> element(std::size_t k) const;
  /// Returns element `k` of this list. Throws InputError if the list is shorter.
  JsonNode at(std::size_t k) const;
  bool is_object() const;
  bool is_string() const;
  bool boolean() const;
  std::string string() const;
  std::string file_name() const;  ///< a string that is not empty
  double number() const;
  std::optional<double> if_number() const;  ///< nothing if this is not a number
  double positive_number() const;
  double number_from_zero() const;  ///< 0 or more
  std::size_t count() const;        ///< a whole number from 0
  Index vertex() const;
  std::vector<Index> vertices() const;
  std::vector<double> numbers() const;
  Eigen::Vector3d vector3() const;

 private:
  struct Value;
  JsonNode(std::shared_ptr<const Value> value, std::string where);
  JsonNode child(const void* json, const std::string& token) const;
  void require_object() const;
  void require_list(const std::string& what) const;

  std::shared_ptr<const Value> value_;
  std::string where_;
};

}  // namespace lapwing
