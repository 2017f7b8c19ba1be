#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/io/gltf_appender.h"
#include "lapwing/io/gltf_layout.h"

namespace lapwing {

/// Changes numbers of a glTF file. Each is written in place, unless several meshes share it, it is
/// an integer position, or it has no place in a buffer. The mesh then gets a new accessor of 32-bit
/// floats at the end of the list.
class GltfNumbers {
 public:
  explicit GltfNumbers(const GltfLayout& layout);

  /// Sets the first three numbers of element `element` of `accessor`, which is the attribute
  /// `attribute` of mesh `mesh`. Throws InputError if a number exceeds the range of 32-bit floats.
  void set(const GltfAccessor& accessor, std::string_view attribute, std::size_t mesh,
           std::size_t element, const Eigen::Vector3d& values);

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
  bool needs_copy(const GltfAccessor& accessor, std::string_view attribute) const;
  double stored(const GltfAccessor& accessor, std::size_t element, std::size_t c) const;
  void check_no_overlap() const;
  void write_bounds(TextEdits& edits) const;
  void add_copies(TextEdits& edits);

  const GltfLayout& layout_;
  std::optional<GltfAppender> appender_;
  std::vector<std::optional<std::string>> buffers_;
  /// Meshes that use an accessor, by its start.
  std::map<Start, std::vector<std::size_t>> meshes_of_;
  std::map<std::size_t, const GltfAccessor*> changed_;
  std::map<std::pair<std::size_t, std::size_t>, Copy> copies_;  // by mesh and accessor
};

}  // namespace lapwing
