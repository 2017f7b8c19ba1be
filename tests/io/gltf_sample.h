#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing::test {

/// Builds a glTF document. Calls fill its buffer and return the numbers of accessors; the rest is
/// given as JSON.
class GltfSample {
 public:
  template <class Number>
  std::size_t add(const std::vector<Number>& numbers, int component_type, std::string_view shape,
                  std::size_t count, const std::string& further = {}) {
    while (buffer_.size() % 4 != 0) buffer_ += '\0';
    const std::size_t offset = buffer_.size();
    const std::size_t size = numbers.size() * sizeof(Number);
    buffer_.append(reinterpret_cast<const char*>(numbers.data()), size);
    add_view(offset, size, further.find("stride:") == 0 ? further.substr(7) : "");
    return add_accessor(R"("bufferView":)" + std::to_string(views_ - 1) + R"(,"componentType":)" +
                        std::to_string(component_type) + R"(,"type":")" + std::string(shape) +
                        R"(","count":)" + std::to_string(count) +
                        (further.find("stride:") == 0 ? "" : further));
  }

  void add_view(std::size_t offset, std::size_t size, const std::string& stride = {}) {
    view_list_ += (views_++ > 0 ? "," : "") +
                  (R"({"buffer":0,"byteOffset":)" + std::to_string(offset)) + R"(,"byteLength":)" +
                  std::to_string(size) + (stride.empty() ? "" : R"(,"byteStride":)" + stride) + "}";
  }

  std::size_t add_accessor(const std::string& members) {
    accessor_list_ += (accessors_ > 0 ? ",{" : "{") + members + "}";
    return accessors_++;
  }

  /// `rest` has the other members of the document, separated by commas. `buffer_members` are added
  /// to the members of the buffer, such as a "uri".
  std::string json(const std::string& rest, const std::string& buffer_members = {}) const {
    return R"({"asset":{"version":"2.0"},)" + rest + R"(,"buffers":[{"byteLength":)" +
           std::to_string(buffer_.size()) + buffer_members + R"(}],"bufferViews":[)" + view_list_ +
           R"(],"accessors":[)" + accessor_list_ + "]}";
  }

  const std::string& buffer() const { return buffer_; }

  /// The chunk of the document begins with `before`.
  std::string glb(const std::string& rest, const std::string& before = {}) const {
    std::string text = before + json(rest);
    while (text.size() % 4 != 0) text += ' ';
    std::string data = buffer_;
    while (data.size() % 4 != 0) data += '\0';
    return word(0x46546C67) + word(2) + word(28 + text.size() + data.size()) + word(text.size()) +
           "JSON" + text + word(data.size()) + std::string("BIN\0", 4) + data;
  }

  static std::string word(std::size_t value) {
    std::string bytes;
    for (int k = 0; k < 4; ++k) bytes += static_cast<char>((value >> (8 * k)) & 0xFF);
    return bytes;
  }

 private:
  std::string buffer_;
  std::string view_list_;
  std::string accessor_list_;
  std::size_t views_ = 0;
  std::size_t accessors_ = 0;
};

}  // namespace lapwing::test
