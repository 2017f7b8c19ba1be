#include "lapwing/io/gltf_edits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/gltf_instances.h"
#include "lapwing/io/writing.h"

namespace lapwing {

namespace {

void append_with_comma(std::string& list, const std::string& element) {
  if (!list.empty()) list += ',';
  list += element;
}

}  // namespace

std::string quoted_json(std::string_view text) {
  // Names of other formats need not be UTF-8.
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string named_materials(std::span<const std::string> names) {
  std::string materials;
  for (const std::string& name : names) {
    append_with_comma(materials, R"({"name":)" + quoted_json(name) + "}");
  }
  return materials;
}

void append_to_list(const JsonText& text, JsonPlace object, std::string_view key,
                    const std::string& elements, TextEdits& edits) {
  if (elements.empty()) return;
  if (const auto list = text.find(object, key)) {
    const bool is_empty = text.elements(*list).empty();
    edits.insert(list->end - 1, (is_empty ? "" : ",") + elements);
    return;
  }
  const std::string_view inside =
      text.text().substr(object.begin + 1, object.end - object.begin - 2);
  const bool is_empty = inside.find_first_not_of(" \t\r\n") == std::string_view::npos;
  edits.insert(object.end - 1, (is_empty ? "" : ",") + quoted_json(key) + ":[" + elements + "]");
}

GltfAppender::GltfAppender(const JsonText& json, std::size_t size)
    : text_(json),
      size_(size),
      views_(count_of("bufferViews")),
      accessors_(count_of("accessors")) {}

std::size_t GltfAppender::count_of(std::string_view list) const {
  const auto place = text_.find(text_.root(), list);
  return place ? text_.elements(*place).size() : 0;
}

std::size_t GltfAppender::add_view(std::string_view bytes, Target target) {
  data_.append((4 - (size_ + data_.size()) % 4) % 4, '\0');
  std::string json = R"({"buffer":0,"byteOffset":)" + std::to_string(size_ + data_.size()) +
                     R"(,"byteLength":)" + std::to_string(bytes.size());
  if (target != Target::none) {
    json += R"(,"target":)" + std::to_string(static_cast<int>(target));
  }
  append_with_comma(new_views_, json + "}");
  data_ += bytes;
  return views_++;
}

std::size_t GltfAppender::add_accessor(const std::string& json) {
  append_with_comma(new_accessors_, json);
  return accessors_++;
}

std::size_t GltfAppender::add_numbers(std::string_view bytes, Scalar type, std::string_view shape,
                                      std::size_t count, Target target, const std::string& bounds) {
  const std::size_t view = add_view(bytes, target);
  return add_accessor(R"({"bufferView":)" + std::to_string(view) + R"(,"componentType":)" +
                      std::to_string(component_type(type)) + R"(,"count":)" +
                      std::to_string(count) + R"(,"type":")" + std::string(shape) + '"' + bounds +
                      "}");
}

void GltfAppender::finish(TextEdits& edits) const {
  const JsonPlace root = text_.root();
  append_to_list(text_, root, "bufferViews", new_views_, edits);
  append_to_list(text_, root, "accessors", new_accessors_, edits);
  const auto buffers = text_.find(root, "buffers");
  if (!buffers || text_.elements(*buffers).empty()) return;
  edits.replace(text_.at(text_.element("buffers", 0), "byteLength"),
                std::to_string(size_ + data_.size()));
}

namespace {

float to_float(double value, const GltfAccessor& accessor) {
  if (std::isfinite(value) && std::abs(value) > double{std::numeric_limits<float>::max()}) {
    throw InputError(accessor.where() +
                     ": a coordinate moved beyond the range of the 32-bit floats of glTF; write "
                     "another format, or scale the mesh");
  }
  return static_cast<float>(value);
}

// Returns the minimum and maximum of each column as two JSON lists. Skips numbers that are not
// finite, because JSON cannot express them.
template <class Number>
std::array<std::string, 2> bounds_of_rows(std::size_t rows, std::size_t width, Scalar type,
                                          const Number& number) {
  std::array<std::string, 2> bounds;
  for (std::size_t c = 0; c < width; ++c) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (std::size_t k = 0; k < rows; ++k) {
      const double x = number(k, c);
      if (!std::isfinite(x)) continue;
      least = std::min(least, x);
      most = std::max(most, x);
    }
    if (least > most) least = most = 0.0;
    for (std::string& bound : bounds) bound += c > 0 ? ',' : '[';
    append_number(bounds[0], least, type);
    append_number(bounds[1], most, type);
  }
  for (std::string& bound : bounds) bound += ']';
  return bounds;
}

}  // namespace

GltfNumbers::GltfNumbers(const GltfLayout& layout)
    : layout_(layout), buffers_(layout.file.buffers().size()) {
  const auto meshes = layout.file.root().find("meshes");
  if (!meshes) return;
  const std::vector<JsonNode> all = meshes->elements();
  mesh_count_ = all.size();
  for (std::size_t m = 0; m < all.size(); ++m) {
    try {
      note_users(all[m], m);
    } catch (const InputError&) {
      // No object uses this mesh, or reading it would have thrown.
    }
  }
}

void GltfNumbers::note_users(const JsonNode& mesh, std::size_t number) {
  for (const JsonNode& primitive : mesh.at("primitives").elements()) {
    const JsonNode attributes = primitive.at("attributes");
    for (const char* name : {"POSITION", "NORMAL", "TANGENT"}) {
      const auto accessor = attributes.find(name);
      if (!accessor) continue;
      std::vector<std::size_t>& users =
          meshes_of_[start_of(GltfAccessor(layout_.file, accessor->count()))];
      if (users.empty() || users.back() != number) users.push_back(number);
    }
  }
}

std::string& GltfNumbers::changeable(std::size_t buffer) {
  std::optional<std::string>& copy = buffers_[buffer];
  if (!copy) copy.emplace(layout_.file.buffers()[buffer].bytes);
  return *copy;
}

GltfNumbers::Start GltfNumbers::start_of(const GltfAccessor& accessor) const {
  const auto range = accessor.range();
  // Accessors without a buffer view are distinguished by their index.
  if (!range) return {buffers_.size(), accessor.number()};
  return {range->buffer, range->begin};
}

bool GltfNumbers::needs_copy(const GltfAccessor& accessor, std::string_view attribute,
                             std::size_t mesh) const {
  if (mesh >= mesh_count_) return true;
  const auto users = meshes_of_.find(start_of(accessor));
  const bool is_shared = users != meshes_of_.end() && users->second.size() > 1;
  return is_shared || !accessor.range() || (attribute == "POSITION" && is_integer(accessor.type()));
}

void GltfNumbers::set(const GltfAccessor& accessor, std::string_view attribute, std::size_t mesh,
                      std::size_t element, const Eigen::Vector3d& values) {
  const std::size_t width = accessor.components();
  const std::optional<GltfPlace> place = accessor.place(element, 0);
  if (!place || needs_copy(accessor, attribute, mesh)) {
    const auto [found, is_new] = copies_.try_emplace(std::pair(mesh, accessor.number()),
                                                     Copy{&accessor, attribute, mesh, {}});
    Copy& copy = found->second;
    if (is_new) {
      copy.values.reserve(accessor.count() * width);
      for (std::size_t k = 0; k < accessor.count(); ++k) {
        for (std::size_t c = 0; c < width; ++c) {
          copy.values.push_back(static_cast<float>(accessor.value(k, c)));
        }
      }
    }
    for (std::size_t c = 0; c < 3; ++c) {
      copy.values[element * width + c] = to_float(values[static_cast<Eigen::Index>(c)], accessor);
    }
    return;
  }
  changed_.emplace(accessor.number(), &accessor);
  for (std::size_t c = 0; c < 3; ++c) {
    double value = accessor.stored(values[static_cast<Eigen::Index>(c)]);
    if (accessor.type() == Scalar::float32) value = double{to_float(value, accessor)};
    store_number(changeable(place->buffer).data() + place->offset + c * size_of(accessor.type()),
                 value, accessor.type(), Encoding::little_endian);
  }
}

double GltfNumbers::stored(const GltfAccessor& accessor, std::size_t element, std::size_t c) const {
  const std::optional<GltfPlace> place = accessor.place(element, c);
  if (!place) return 0.0;
  const std::optional<std::string>& copy = buffers_[place->buffer];
  const std::string_view bytes =
      copy ? std::string_view(*copy) : layout_.file.buffers()[place->buffer].bytes;
  return load_number(bytes.data() + place->offset, accessor.type(), Encoding::little_endian);
}

void GltfNumbers::check_no_overlap() const {
  for (const auto& [number, accessor] : changed_) {
    for (const GltfAccessor::Range& range : accessor->ranges()) {
      for (const GltfAccessor::Range& other : layout_.indices) {
        if (other.buffer != range.buffer || other.begin >= range.end || range.begin >= other.end) {
          continue;
        }
        throw InputError(accessor->where() +
                         ": the moved vertices share bytes with the corners of triangles; export "
                         "the file again");
      }
    }
  }
}

void GltfNumbers::write_bounds(TextEdits& edits) const {
  if (changed_.empty()) return;
  const JsonText& text = layout_.file.json();
  const std::vector<JsonPlace> accessors = text.elements(text.at(text.root(), "accessors"));
  for (const auto& [number, accessor] : changed_) {
    const auto least = text.find(accessors.at(number), "min");
    const auto most = text.find(accessors.at(number), "max");
    if (!least && !most) continue;
    const auto bounds = bounds_of_rows(
        accessor->count(), accessor->components(), accessor->type(),
        [this, held = accessor](std::size_t k, std::size_t c) { return stored(*held, k, c); });
    if (least) edits.replace(*least, bounds[0]);
    if (most) edits.replace(*most, bounds[1]);
  }
}

std::size_t GltfNumbers::add_accessor(const Copy& copy) {
  const std::size_t width = copy.accessor->components();
  std::string bytes;
  for (const float value : copy.values) {
    append_binary(bytes, double{value}, Scalar::float32, Encoding::little_endian);
  }
  std::string bounds;
  if (copy.attribute == "POSITION") {
    const auto [least, most] =
        bounds_of_rows(copy.accessor->count(), width, Scalar::float32,
                       [width, &values = copy.values](std::size_t k, std::size_t c) {
                         return double{values[k * width + c]};
                       });
    bounds = R"(,"min":)" + least + R"(,"max":)" + most;
  }
  return appender().add_numbers(bytes, Scalar::float32, width == 3 ? "VEC3" : "VEC4",
                                copy.accessor->count(), GltfAppender::Target::vertices, bounds);
}

void GltfNumbers::add_copies(TextEdits& edits) {
  if (copies_.empty()) return;
  const JsonText& text = layout_.file.json();
  const std::vector<JsonPlace> meshes = text.elements(text.at(text.root(), "meshes"));
  const std::vector<JsonNode> nodes = layout_.file.root().at("meshes").elements();
  std::vector<TextEdits> of_separate(separate_.size());
  for (const auto& [key, copy] : copies_) {
    const std::string number = std::to_string(add_accessor(copy));
    const bool is_separate = copy.mesh >= mesh_count_;
    const std::size_t mesh =
        is_separate ? layout_.objects[separate_[copy.mesh - mesh_count_]].mesh : copy.mesh;
    const std::vector<JsonNode> primitives = nodes.at(mesh).at("primitives").elements();
    const std::vector<JsonPlace> places = text.elements(text.at(meshes.at(mesh), "primitives"));
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const auto old = primitives[p].at("attributes").find(copy.attribute);
      if (!old || old->count() != copy.accessor->number()) continue;
      const JsonPlace place = text.at(text.at(places.at(p), "attributes"), copy.attribute);
      if (!is_separate) {
        edits.replace(place, number);
      } else {
        const std::size_t begin = meshes[mesh].begin;
        of_separate[copy.mesh - mesh_count_].replace({place.begin - begin, place.end - begin},
                                                     number);
      }
    }
  }
  add_separate_meshes(of_separate, edits);
}

// `changes[k]` contains the edits to the new copy of the mesh that object separate_[k] shows.
void GltfNumbers::add_separate_meshes(std::span<const TextEdits> changes, TextEdits& edits) const {
  const JsonText& text = layout_.file.json();
  std::string added;
  for (std::size_t k = 0; k < separate_.size(); ++k) {
    const GltfObject& object = layout_.objects[separate_[k]];
    const JsonPlace mesh = text.element("meshes", object.mesh);
    append_with_comma(added,
                      changes[k].applied_to(text.text().substr(mesh.begin, mesh.end - mesh.begin)));
    edits.replace(text.at(text.element("nodes", object.node), "mesh"),
                  std::to_string(mesh_count_ + k));
  }
  append_to_list(text, text.root(), "meshes", added, edits);
}

std::size_t GltfNumbers::separate(std::size_t object) {
  require_own_node(layout_.objects[object]);
  separate_.push_back(object);
  return mesh_count_ + separate_.size() - 1;
}

GltfAppender& GltfNumbers::appender() {
  if (buffers_.empty()) {
    throw InputError(layout_.file.source().path().string() +
                     ": the file has no buffer to store moved vertices in; export it again");
  }
  if (!appender_) {
    appender_.emplace(layout_.file.json(), layout_.file.buffers()[0].bytes.size());
  }
  return *appender_;
}

void GltfNumbers::finish(TextEdits& edits) {
  check_no_overlap();
  write_bounds(edits);
  add_copies(edits);
  if (!appender_) return;
  appender_->finish(edits);
  changeable(0) += appender_->data();
}

}  // namespace lapwing
