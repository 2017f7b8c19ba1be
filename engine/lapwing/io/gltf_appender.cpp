#include "lapwing/io/gltf_appender.h"

#include <nlohmann/json.hpp>

namespace lapwing {
namespace {

void append_with_comma(std::string& list, const std::string& element) {
  if (!list.empty()) list += ',';
  list += element;
}

}  // namespace

int component_type(Scalar type) {
  switch (type) {
    case Scalar::int8:
      return 5120;
    case Scalar::uint8:
      return 5121;
    case Scalar::int16:
      return 5122;
    case Scalar::uint16:
      return 5123;
    case Scalar::uint32:
      return 5125;
    default:
      return 5126;
  }
}

std::string quoted_json(std::string_view text) {
  // Names of other formats need not be UTF-8.
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void append_to_list(const JsonText& text, JsonPlace object, std::string_view key,
                    const std::string& elements, TextEdits& edits) {
  if (elements.empty()) return;
  if (const auto list = text.member(object, key)) {
    const bool is_empty = text.elements(*list).empty();
    edits.insert(list->end - 1, (is_empty ? "" : ",") + elements);
    return;
  }
  const std::string_view inside =
      text.text().substr(object.begin + 1, object.end - object.begin - 2);
  const bool is_empty = inside.find_first_not_of(" \t\r\n") == std::string_view::npos;
  edits.insert(object.end - 1, (is_empty ? "" : ",") + quoted_json(key) + ":[" + elements + "]");
}

GltfAppender::GltfAppender(std::string_view json, std::size_t buffer, std::size_t size)
    : text_(json),
      buffer_(buffer),
      size_(size),
      views_(count_of("bufferViews")),
      accessors_(count_of("accessors")) {}

std::size_t GltfAppender::count_of(std::string_view list) const {
  const auto place = text_.member(text_.root(), list);
  return place ? text_.elements(*place).size() : 0;
}

std::size_t GltfAppender::add_view(std::string_view bytes, Target target) {
  data_.append((4 - (size_ + data_.size()) % 4) % 4, '\0');
  std::string json = R"({"buffer":)" + std::to_string(buffer_) + R"(,"byteOffset":)" +
                     std::to_string(size_ + data_.size()) + R"(,"byteLength":)" +
                     std::to_string(bytes.size());
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
  const auto buffers = text_.member(root, "buffers");
  const auto places = buffers ? text_.elements(*buffers) : std::vector<JsonPlace>();
  if (buffer_ < places.size()) {
    edits.replace(*text_.member(places[buffer_], "byteLength"),
                  std::to_string(size_ + data_.size()));
  }
}

}  // namespace lapwing
