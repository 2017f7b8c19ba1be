#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "lapwing/io/mesh_format.h"
#include "lapwing/json/json_text.h"

namespace lapwing {

/// Adds data to a glTF document: accessors and buffer views at the end of their lists, so that all
/// numbers in it stay what they are, and bytes at the end of one buffer.
class GltfAppender {
 public:
  /// `json` is valid, and outlives this. Appends to buffer number `buffer`, which has `size` bytes
  /// so far.
  GltfAppender(std::string_view json, std::size_t buffer, std::size_t size);

  enum class Target : std::uint16_t { none = 0, vertices = 34962, indices = 34963 };

  /// A buffer view of `bytes`; its number. `stride` is 0 for elements one behind the other.
  std::size_t add_view(std::string_view bytes, Target target);
  /// An accessor, as its JSON says; its number.
  std::size_t add_accessor(const std::string& json);
  /// An accessor of all of a new view. `bounds` is `,"min":[...],"max":[...]` or empty.
  std::size_t add_numbers(std::string_view bytes, Scalar type, std::string_view shape,
                          std::size_t count, Target target, const std::string& bounds = {});

  /// What is to be appended to the buffer.
  const std::string& data() const { return data_; }
  /// Puts what was added into the document, with the new "byteLength" of a buffer that was there.
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

/// Adds `elements`, separated by commas, to the list that `key` is in the object at `object`, which
/// is made where there is none.
void append_to_list(const JsonText& text, JsonPlace object, std::string_view key,
                    const std::string& elements, TextEdits& edits);

/// What the specification calls a type of numbers.
int component_type(Scalar type);

/// `text` in quotes, as JSON has it.
std::string quoted_json(std::string_view text);

}  // namespace lapwing
