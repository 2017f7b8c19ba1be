#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/gltf_file.h"

namespace lapwing {

/// Where a number stands: in which buffer, and from which of its bytes on.
struct GltfPlace {
  std::size_t buffer = 0;
  std::uint64_t offset = 0;
};

/// A list of numbers or vectors in the buffers of a glTF file. Elements that a sparse accessor
/// replaces stand elsewhere than the others; those of one without a buffer view are 0 and stand
/// nowhere.
class GltfAccessor {
 public:
  /// Throws InputError, naming the accessor, where it reaches beyond its buffer, has another form
  /// than the specification knows, or a sparse index is out of order.
  GltfAccessor(const GltfFile& file, std::size_t number);

  std::size_t number() const { return number_; }  ///< in the file's list
  std::size_t count() const { return count_; }
  std::size_t components() const { return components_; }
  Scalar type() const { return type_; }
  bool is_normalized() const { return is_normalized_; }
  bool is_sparse() const { return !sparse_.empty(); }

  std::optional<GltfPlace> place(std::size_t element, std::size_t component) const;
  double value(std::size_t element, std::size_t component) const;
  Eigen::Vector3d vector3(std::size_t element) const {
    return {value(element, 0), value(element, 1), value(element, 2)};
  }
  /// The number that is stored for `value`: scaled where whole numbers stand for parts of 1.
  double stored(double value) const;

  /// The first byte and the one behind the last of what is not sparse; nothing where it is all 0.
  struct Range {
    std::size_t buffer = 0;
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
  };
  std::optional<Range> range() const;
  /// All that its numbers stand in, those of a sparse accessor included.
  std::vector<Range> ranges() const;
  /// Where a sparse accessor says which elements it replaces.
  std::optional<Range> sparse_indices() const { return sparse_range_; }

  const std::string& where() const { return where_; }  ///< as messages begin

 private:
  // Elements one behind the other, `stride` bytes apart.
  struct Strided {
    GltfPlace first;
    std::uint64_t stride = 0;
  };
  Strided strided(const GltfFile& file, const JsonNode& accessor, const char* offset_key,
                  std::size_t count, std::uint64_t element_size, bool may_stride) const;
  void read_sparse(const GltfFile& file, const JsonNode& node);
  double load(GltfPlace place) const;

  const GltfFile* file_;
  std::string where_;
  std::size_t number_;
  std::size_t count_ = 0;
  std::size_t components_ = 1;
  Scalar type_ = Scalar::float32;
  bool is_normalized_ = false;
  std::optional<Strided> dense_;
  std::vector<Index> sparse_;  // elements that stand in sparse_values_, ascending
  Strided sparse_values_;
  std::optional<Range> sparse_range_;
};

}  // namespace lapwing
