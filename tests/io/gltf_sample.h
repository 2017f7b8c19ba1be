#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/mesh/mesh.h"

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

/// A square of two triangles that share no vertex of the file, as at a seam of the texture.
struct Square {
  GltfSample sample;
  std::string primitive;

  Square() {
    const std::vector<float> points{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0};
    std::vector<float> normals;
    std::vector<float> tangents;
    for (int k = 0; k < 6; ++k) {
      normals.insert(normals.end(), {0, 0, 1});
      tangents.insert(tangents.end(), {1, 0, 0, -1});
    }
    const auto p = sample.add(points, 5126, "VEC3", 6, R"(,"min":[0,0,0],"max":[1,1,0])");
    const auto n = sample.add(normals, 5126, "VEC3", 6);
    const auto t = sample.add(tangents, 5126, "VEC4", 6);
    const auto uv =
        sample.add(std::vector<float>{0, 1, 1, 1, 1, 0, .5F, 1, .5F, 0, 0, 0}, 5126, "VEC2", 6);
    primitive = R"({"attributes":{"POSITION":)" + std::to_string(p) + R"(,"NORMAL":)" +
                std::to_string(n) + R"(,"TANGENT":)" + std::to_string(t) + R"(,"TEXCOORD_0":)" +
                std::to_string(uv) + R"(},"material":0})";
  }

  std::string rest(const std::string& node = "") const {
    return R"("scenes":[{"nodes":[0]}],"nodes":[{"name":"Flag","mesh":0)" + node +
           R"(}],"materials":[{"name":"cloth"}],"meshes":[{"primitives":[)" + primitive + "]}]";
  }
};

/// Two objects. The second has a skin, and other accessors.
inline std::string two_objects(GltfSample& sample) {
  std::string primitives[2];
  for (std::string& primitive : primitives) {
    const auto p = sample.add(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 5126, "VEC3",
                              4, R"(,"min":[0,0,0],"max":[1,1,0])");
    const auto i = sample.add(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 6);
    primitive = R"({"attributes":{"POSITION":)" + std::to_string(p) + R"(},"indices":)" +
                std::to_string(i) + R"(,"material":1})";
  }
  return R"("scenes":[{"nodes":[0,1]}],"nodes":[{"name":"Left","mesh":0,"scale":[2,2,2]},)"
         R"({"name":"Right","mesh":1,"skin":0,"weights":[]}],"skins":[{"joints":[0]}],)"
         R"("materials":[{"name":"wool"},{"name":"wax"}],"meshes":[{"primitives":[)" +
         primitives[0] + R"(]},{"primitives":[)" + primitives[1] + "]}]";
}

/// Removes the last face, as a step does that changes the triangles.
inline Mesh without_last_face(const Mesh& mesh) {
  Mesh cut = mesh;
  cut.source.reset();
  Faces& faces = cut.edit_faces();
  faces.starts.pop_back();
  faces.vertices.resize(faces.starts.back());
  MeshAttributes& attributes = cut.edit_attributes();
  attributes.face_groups.pop_back();
  attributes.face_materials.pop_back();
  for (auto* corners : {&attributes.corner_uvs, &attributes.corner_normals}) {
    if (!corners->empty()) corners->resize(faces.vertices.size());
  }
  return cut;
}

}  // namespace lapwing::test
