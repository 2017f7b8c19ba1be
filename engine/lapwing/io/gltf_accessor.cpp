#include "lapwing/io/gltf_accessor.h"

#include <algorithm>
#include <array>
#include <limits>

#include "lapwing/io/binary_numbers.h"
#include "lapwing/json/suggest.h"

namespace lapwing {
namespace {

Scalar type_of(const JsonNode& node) {
  for (const Scalar type : {Scalar::int8, Scalar::uint8, Scalar::int16, Scalar::uint16,
                            Scalar::uint32, Scalar::float32}) {
    if (node.count() == component_type(type)) return type;
  }
  node.fail_expecting("a component type (5120 to 5123, 5125 or 5126)");
}

std::size_t components_of(const JsonNode& node) {
  static const std::vector<std::string_view> kTypes{"SCALAR", "VEC2", "VEC3", "VEC4",
                                                    "MAT2",   "MAT3", "MAT4"};
  constexpr std::array<std::size_t, 7> kComponents{1, 2, 3, 4, 4, 9, 16};
  return kComponents[node.one_of("type", kTypes)];
}

// Returns the number by which a normalized accessor divides its integers. The number is 1 for types
// of 32 bits, which cannot be normalized.
double largest(Scalar type) {
  return detail::with_type_of(type, []<class T>(T) {
    return sizeof(T) < 4 ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0;
  });
}

std::size_t count_or(const JsonNode& node, const char* key, std::size_t otherwise) {
  const auto found = node.find(key);
  return found ? found->count() : otherwise;
}

// Returns element `number` of the document's list `list`.
JsonNode element_of(const GltfFile& file, const char* list, const JsonNode& number) {
  const auto nodes = file.root().find(list);
  const std::size_t k = number.count();
  if (nodes) {
    if (const auto node = nodes->element(k)) return *node;
  }
  number.fail("there is no element " + std::to_string(k) + " of \"" + list +
              "\"; export the file again");
}

}  // namespace

GltfAccessor::GltfAccessor(const GltfFile& file, std::size_t number)
    : file_(&file), number_(number) {
  const auto nodes = file.root().find("accessors");
  const auto node = nodes ? nodes->element(number) : std::nullopt;
  if (!node) {
    file.root().fail("there is no accessor " + std::to_string(number) + "; export the file again");
  }
  where_ = node->where();
  count_ = node->at("count").count();
  if (count_ >= kNoIndex)
    node->at("count").fail("the accessor has more than 4,294,967,294 elements");
  components_ = components_of(node->at("type"));
  type_ = type_of(node->at("componentType"));
  const auto normalized = node->find("normalized");
  is_normalized_ = normalized && normalized->boolean();
  if (node->has("bufferView")) {
    dense_ = strided(file, *node, "byteOffset", count_, components_ * size_of(type_), true);
  }
  if (const auto sparse = node->find("sparse")) read_sparse(file, *sparse);
}

GltfAccessor::Strided GltfAccessor::strided(const GltfFile& file, const JsonNode& accessor,
                                            const char* offset_key, std::size_t count,
                                            std::uint64_t element_size, bool may_stride) const {
  const JsonNode view = element_of(file, "bufferViews", accessor.at("bufferView"));
  for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const auto extensions = view.find("extensions");
    if (extensions && extensions->has(extension)) {
      view.fail(
          "the buffer view is compressed by meshopt, which is not supported; export the file "
          "without compression");
    }
  }
  const std::size_t buffer = view.at("buffer").count();
  if (buffer >= file.buffers().size()) {
    view.fail("the buffer " + std::to_string(buffer) + " does not exist; export the file again");
  }
  const std::uint64_t length = view.at("byteLength").count();
  const std::uint64_t begin = count_or(view, "byteOffset", 0);
  if (begin > file.buffers()[buffer].bytes.size() ||
      length > file.buffers()[buffer].bytes.size() - begin) {
    view.fail("the buffer view extends beyond the end of its buffer; export the file again");
  }
  Strided result;
  result.stride = may_stride ? count_or(view, "byteStride", element_size) : element_size;
  if (result.stride < element_size && count > 1) {
    view.fail("\"byteStride\" is smaller than an element; export the file again");
  }
  const std::uint64_t offset = count_or(accessor, offset_key, 0);
  result.first = {buffer, begin + offset};
  if (count == 0) return result;
  // This order avoids overflow: sizes are below 2^53, counts below 2^32, strides within the view.
  if (count > 1 && result.stride > length) {
    view.fail("\"byteStride\" is larger than the buffer view; export the file again");
  }
  const std::uint64_t needed = (count - 1) * result.stride + element_size;
  if (offset > length || needed > length - offset) {
    accessor.fail("the accessor extends beyond the end of its buffer view; export the file again");
  }
  return result;
}

void GltfAccessor::read_sparse(const GltfFile& file, const JsonNode& node) {
  const std::size_t count = node.at("count").count();
  if (count > count_) {
    node.fail("the accessor has " + std::to_string(count_) + " elements, but " +
              std::to_string(count) + " are replaced; export the file again");
  }
  const JsonNode indices = node.at("indices");
  const Scalar index_type = type_of(indices.at("componentType"));
  if (index_type != Scalar::uint8 && index_type != Scalar::uint16 && index_type != Scalar::uint32) {
    indices.fail("expected unsigned integers (component type 5121, 5123 or 5125)");
  }
  const Strided places = strided(file, indices, "byteOffset", count, size_of(index_type), false);
  sparse_values_ =
      strided(file, node.at("values"), "byteOffset", count, components_ * size_of(type_), false);
  if (count > 0) {
    sparse_range_ = Range{places.first.buffer, places.first.offset,
                          places.first.offset + count * places.stride};
  }
  sparse_.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double index = load_number(
        file.buffers()[places.first.buffer].bytes.data() + places.first.offset + k * places.stride,
        index_type, Encoding::little_endian);
    if (index >= static_cast<double>(count_) || (k > 0 && index <= sparse_.back())) {
      indices.fail("index " + std::to_string(k) +
                   " must be greater than the index before it, and less than the number of "
                   "elements (" +
                   std::to_string(count_) + ")");
    }
    sparse_.push_back(static_cast<Index>(index));
  }
}

std::optional<GltfPlace> GltfAccessor::place(std::size_t element, std::size_t component) const {
  const std::uint64_t within = component * size_of(type_);
  const auto at = [&](const Strided& list, std::size_t k) {
    return GltfPlace{list.first.buffer, list.first.offset + k * list.stride + within};
  };
  if (!sparse_.empty()) {
    const auto found = std::ranges::lower_bound(sparse_, static_cast<Index>(element));
    if (found != sparse_.end() && *found == element) {
      return at(sparse_values_, static_cast<std::size_t>(found - sparse_.begin()));
    }
  }
  if (!dense_) return std::nullopt;
  return at(*dense_, element);
}

double GltfAccessor::load(GltfPlace place) const {
  return load_number(file_->buffers()[place.buffer].bytes.data() + place.offset, type_,
                     Encoding::little_endian);
}

double GltfAccessor::value(std::size_t element, std::size_t component) const {
  const std::optional<GltfPlace> at = place(element, component);
  const double number = at ? load(*at) : 0.0;
  return is_normalized_ ? std::max(number / largest(type_), -1.0) : number;
}

double GltfAccessor::stored(double value) const {
  return is_normalized_ ? value * largest(type_) : value;
}

std::optional<GltfAccessor::Range> GltfAccessor::range() const {
  if (!dense_ || count_ == 0) return std::nullopt;
  return Range{dense_->first.buffer, dense_->first.offset,
               dense_->first.offset + (count_ - 1) * dense_->stride + components_ * size_of(type_)};
}

std::vector<GltfAccessor::Range> GltfAccessor::ranges() const {
  std::vector<Range> all;
  if (const auto dense = range()) all.push_back(*dense);
  if (!sparse_.empty()) {
    const GltfPlace& first = sparse_values_.first;
    all.push_back(
        {first.buffer, first.offset, first.offset + sparse_.size() * sparse_values_.stride});
  }
  return all;
}

}  // namespace lapwing
