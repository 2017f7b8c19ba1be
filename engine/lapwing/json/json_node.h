#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A value in a JSON document that knows where it stands. Every accessor checks the type and throws
/// InputError "NAME: /json/pointer: expected ..., got ..." otherwise. Cheap to copy; keeps the
/// document alive.
class JsonNode {
 public:
  /// The root of `text`. Throws InputError with line and column when it is no JSON, and when an
  /// object names a key twice.
  static JsonNode parse(std::string_view text, const std::string& name);
  /// The root of a document that is no text (parse_json.h).
  struct Document;
  static JsonNode of(Document document, const std::string& name);

  /// Document and JSON pointer, as messages begin.
  const std::string& where() const { return where_; }
  /// The same of what `pointer`, without a first slash, leads to from here.
  std::string where(std::string_view pointer) const;
  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_expecting(const std::string& what) const;

  /// This is an object and has no other keys; an unknown one is answered with the nearest.
  void require_keys(const std::vector<std::string_view>& known) const;
  std::vector<std::string> keys() const;  ///< of this object, sorted
  bool has(std::string_view key) const;
  JsonNode at(std::string_view key) const;
  std::optional<JsonNode> find(std::string_view key) const;
  /// The one of `keys` that this object has; none and several are errors about `what`.
  std::string_view only_key_of(const std::vector<std::string_view>& keys,
                               const std::string& what) const;

  /// Which of `names` this string is, from 0; "unknown WHAT ..." and the nearest name otherwise.
  std::size_t one_of(const std::string& what, const std::vector<std::string_view>& names) const;

  std::vector<JsonNode> elements() const;
  /// Element `k` of this list; nothing where it has fewer.
  std::optional<JsonNode> element(std::size_t k) const;
  bool is_object() const;
  bool is_string() const;
  bool boolean() const;
  std::string string() const;
  std::string file_name() const;  ///< a text that is not empty
  double number() const;
  std::optional<double> if_number() const;  ///< nothing where this is no number
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
