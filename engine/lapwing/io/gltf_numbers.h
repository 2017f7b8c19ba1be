#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/io/gltf_appender.h"
#include "lapwing/io/gltf_layout.h"

namespace lapwing {

/// The numbers of a glTF file, some of which are changed. Each is written where it stands, unless
/// that would change something else too (numbers that several meshes share) or cannot hold it
/// (positions in whole numbers, and those that a sparse accessor has nowhere): then the mesh gets
/// an accessor of its own, of 32-bit floats, behind all others.
class GltfNumbers {
 public:
  explicit GltfNumbers(const GltfLayout& layout);

  /// The first three numbers of element `element` of `accessor`, which is mesh `mesh`'s attribute
  /// `attribute`. Throws InputError for a number beyond 32-bit floats.
  void set(const GltfAccessor& accessor, std::string_view attribute, std::size_t mesh,
           std::size_t element, const Eigen::Vector3d& values);

  /// What adds data to the first buffer. Throws InputError where there is none.
  GltfAppender& appender();

  bool has_changed() const { return !changed_.empty() || !copies_.empty(); }

  /// Puts bounds ("min", "max") of what changed and the accessors that were added into the
  /// document. Throws InputError where what was changed stands in the same bytes as the corners of
  /// triangles.
  void finish(TextEdits& edits);

  /// Of buffer `number`, if it changed.
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
  void require_apart() const;
  void write_bounds(TextEdits& edits) const;
  void add_copies(TextEdits& edits);

  const GltfLayout& layout_;
  std::optional<GltfAppender> appender_;
  std::vector<std::optional<std::string>> buffers_;
  /// By where they begin, the meshes whose attributes the numbers are.
  std::map<Start, std::vector<std::size_t>> meshes_of_;
  std::map<std::size_t, const GltfAccessor*> changed_;
  std::map<std::pair<std::size_t, std::size_t>, Copy> copies_;  // by mesh and accessor
};

}  // namespace lapwing
