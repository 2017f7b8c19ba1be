#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "lapwing/io/mesh_format.h"
#include "lapwing/json/json_text.h"

namespace lapwing {

/// Appends data to a glTF document: accessors and buffer views to their lists, so that existing
/// indices stay valid, and bytes to one buffer.
class GltfAppender {
 public:
  /// `json` must be valid and outlive this object. Bytes are appended to buffer number `buffer`,
  /// which has `size` bytes so far.
  GltfAppender(std::string_view json, std::size_t buffer, std::size_t size);

  enum class Target : std::uint16_t { none = 0, vertices = 34962, indices = 34963 };

  /// Adds a buffer view of `bytes` and returns its index.
  std::size_t add_view(std::string_view bytes, Target target);
  /// Adds an accessor, given as JSON, and returns its index.
  std::size_t add_accessor(const std::string& json);
  /// Adds a buffer view with an accessor for all of it, and returns the accessor's index. `shape`
  /// is its "type", such as VEC3. `bounds` is `,"min":[...],"max":[...]` or empty.
  std::size_t add_numbers(std::string_view bytes, Scalar type, std::string_view shape,
                          std::size_t count, Target target, const std::string& bounds = {});

  /// The bytes to append to the buffer.
  const std::string& data() const { return data_; }
  /// Inserts the additions into the document, and updates the "byteLength" of an existing buffer.
  void finish(TextEdits& edits) const;

 private:
  std::size_t count_of(std::string_view list) const;

  JsonText text_;
  std::size_t buffer_;
  std::size_t size_;
  std::size_t views_;
  std::size_t accessors_;
  std::string data_;
  std::string new_views_;
  std::string new_accessors_;
};

/// Appends `elements`, separated by commas, to the list `key` of the object at `object`. Creates
/// the list if there is none.
void append_to_list(const JsonText& text, JsonPlace object, std::string_view key,
                    const std::string& elements, TextEdits& edits);

/// Returns the "componentType" of the specification for `type`.
int component_type(Scalar type);

/// Returns `text` as a JSON string, with quotes.
std::string quoted_json(std::string_view text);

}  // namespace lapwing
