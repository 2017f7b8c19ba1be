#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/io/gltf_scene.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/json/json_text.h"

namespace lapwing {

/// Appends data to a glTF document. Accessors and buffer views go to the ends of their lists, so
/// that existing indices stay valid. Bytes go to the end of the first buffer.
class GltfAppender {
 public:
  /// `json` must outlive this object. `size` is the size of the first buffer in bytes.
  GltfAppender(const JsonText& json, std::size_t size);

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

  const JsonText& text_;
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

/// Returns one JSON object for each material name. Commas separate the objects.
std::string named_materials(std::span<const std::string> names);

/// Returns `text` as a JSON string, with quotes.
std::string quoted_json(std::string_view text);

/// Changes numbers of a glTF file. Most numbers are changed in place. The mesh gets a new accessor
/// of 32-bit floats at the end of the list if several meshes share the number, if it is an integer
/// position, or if no buffer contains it. `separate` gives an object its own copy of its mesh.
class GltfNumbers {
 public:
  explicit GltfNumbers(const GltfLayout& layout);

  /// Sets the first three numbers of element `element` of `accessor`, which is the attribute
  /// `attribute` of mesh `mesh`. Throws InputError if a number exceeds the range of 32-bit floats.
  void set(const GltfAccessor& accessor, std::string_view attribute, std::size_t mesh,
           std::size_t element, const Eigen::Vector3d& values);

  /// Appends a copy of the mesh of object `object` to the list of meshes, and makes the object show
  /// it. Returns the index of the copy. Call `set` with this index at least once. Throws what
  /// `require_own_node` throws.
  std::size_t separate(std::size_t object);

  /// Returns the appender for the first buffer. Throws InputError if there is no buffer.
  GltfAppender& appender();

  bool has_changed() const { return !changed_.empty() || !copies_.empty(); }

  /// Adds the new accessors and the bounds ("min", "max") of the changed ones to the document.
  /// Throws InputError if a changed accessor shares bytes with triangle indices.
  void finish(TextEdits& edits);

  /// Returns the new bytes of buffer `number` if it changed.
  const std::optional<std::string>& buffer(std::size_t number) const { return buffers_[number]; }

 private:
  using Start = std::pair<std::size_t, std::uint64_t>;
  struct Copy {
    const GltfAccessor* accessor;
    std::string_view attribute;
    std::size_t mesh;
    std::vector<float> values;
  };

  void note_users(const JsonNode& mesh, std::size_t number);
  std::string& changeable(std::size_t buffer);
  Start start_of(const GltfAccessor& accessor) const;
  bool needs_copy(const GltfAccessor& accessor, std::string_view attribute, std::size_t mesh) const;
  double stored(const GltfAccessor& accessor, std::size_t element, std::size_t c) const;
  void check_no_overlap() const;
  void write_bounds(TextEdits& edits) const;
  std::size_t add_accessor(const Copy& copy);
  void add_copies(TextEdits& edits);
  void add_separate_meshes(std::span<const TextEdits> changes, TextEdits& edits) const;

  const GltfLayout& layout_;
  std::optional<GltfAppender> appender_;
  std::vector<std::optional<std::string>> buffers_;
  std::size_t mesh_count_ = 0;
  std::vector<std::size_t> separate_;  // object separate_[k] shows mesh mesh_count_ + k
  /// Meshes that use an accessor, keyed by the accessor's start.
  std::map<Start, std::vector<std::size_t>> meshes_of_;
  std::map<std::size_t, const GltfAccessor*> changed_;
  std::map<std::pair<std::size_t, std::size_t>, Copy> copies_;  // by mesh and accessor
};

}  // namespace lapwing
