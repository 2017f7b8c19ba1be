#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/gltf_file.h"

namespace lapwing {

/// Returns the "componentType" that the glTF specification assigns to `type`. `type` must be a
/// number type that glTF supports.
constexpr unsigned component_type(Scalar type) {
  return 5120U + static_cast<unsigned>(type);
}

/// Location of a number: its buffer and its first byte.
struct GltfPlace {
  std::size_t buffer = 0;
  std::uint64_t offset = 0;
};

/// A list of numbers or vectors in the buffers of a glTF file. Elements that a sparse accessor
/// replaces are stored apart from the others. Without a buffer view, the others are 0 and have no
/// place.
class GltfAccessor {
 public:
  /// Throws InputError, naming the accessor, if it reaches beyond its buffer, violates the
  /// specification, or has sparse indices out of order.
  GltfAccessor(const GltfFile& file, std::size_t number);

  std::size_t number() const { return number_; }  ///< index into "accessors"
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
  /// Returns the number to store for `value`: scaled if the accessor is normalized.
  double stored(double value) const;

  /// Bytes [begin, end) of a buffer.
  struct Range {
    std::size_t buffer = 0;
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
  };
  /// Returns the range of the elements that are not sparse; nullopt if they have no place.
  std::optional<Range> range() const;
  /// Returns all ranges with elements, including the sparse ones.
  std::vector<Range> ranges() const;
  /// Returns the range of the sparse indices.
  std::optional<Range> sparse_indices() const { return sparse_range_; }

  const std::string& where() const { return where_; }  ///< for messages

 private:
  // Elements `stride` bytes apart.
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
  std::vector<Index> sparse_;  // elements stored in sparse_values_, ascending
  Strided sparse_values_;
  std::optional<Range> sparse_range_;
};

}  // namespace lapwing
