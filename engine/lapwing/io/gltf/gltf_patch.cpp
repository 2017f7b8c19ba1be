#include "lapwing/io/gltf/gltf_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <system_error>

#include "lapwing/base/errors.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/gltf/base64.h"
#include "lapwing/io/gltf/gltf_layout.h"
#include "lapwing/io/gltf/gltf_tangents.h"
#include "lapwing/io/gltf/uri.h"
#include "lapwing/io/real_path.h"
#include "lapwing/io/source_patch.h"
#include "lapwing/io/stored_normals.h"
#include "lapwing/io/writing.h"
#include "lapwing/json/json_text.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

bool is_same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

bool are_same(const Vector3d& a, const Vector3d& b) {
  return is_same(a.x(), b.x()) && is_same(a.y(), b.y()) && is_same(a.z(), b.z());
}

// The largest difference of a carried tangent that is none: rounding on the way there.
constexpr double kSameDirection = 1e-6;

class GltfPatch {
 public:
  GltfPatch(const SourceFile& source, const Mesh& mesh, WriteReport& report)
      : source_(source),
        layout_(*source.gltf),
        mesh_(mesh),
        report_(report),
        buffers_(layout_.file.buffers().size()) {}

  std::vector<FileContent> run(const fs::path& target) {
    for (const GltfRecords& set : layout_.records) move(set);
    if (!moved_.empty()) {
      require_unshared();
      turn();
      write_bounds();
      note_rounding();
    }
    return files_at(target);
  }

 private:
  std::string& buffer(std::size_t number) {
    std::optional<std::string>& copy = buffers_[number];
    if (!copy) copy.emplace(layout_.file.buffers()[number].bytes);
    return *copy;
  }

  void store(const GltfAccessor& accessor, std::size_t element, const Vector3d& values) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto place = accessor.place(element, c);
      if (!place) {
        throw InputError(accessor.where() +
                         ": a position that moved stands nowhere in the file, since the accessor "
                         "has no buffer view; export the file without sparse positions");
      }
      const double value = accessor.stored(values[static_cast<Eigen::Index>(c)]);
      store_number(buffer(place->buffer).data() + place->offset, value, accessor.type(),
                   Encoding::little_endian);
    }
  }

  double stored_number(const GltfAccessor& accessor, std::size_t element, std::size_t c) const {
    const auto place = accessor.place(element, c);
    if (!place) return 0.0;
    const std::optional<std::string>& copy = buffers_[place->buffer];
    const std::string_view bytes =
        copy ? std::string_view(*copy) : layout_.file.buffers()[place->buffer].bytes;
    return load_number(bytes.data() + place->offset, accessor.type(), Encoding::little_endian);
  }

  void require_room(const GltfAccessor& accessor, Index vertex, const Vector3d& local) {
    for (const double x : local) {
      const double value = accessor.stored(x);
      if (!std::isfinite(value)) continue;
      if (accessor.type() == Scalar::float32) {
        if (std::abs(value) <= std::numeric_limits<float>::max()) continue;
      } else {
        const double rounded = std::round(value);
        constexpr double k8 = 127.0;
        constexpr double k16 = 32767.0;
        const auto [least, most] = [&]() -> std::pair<double, double> {
          switch (accessor.type()) {
            case Scalar::int8:
              return {-k8 - (accessor.is_normalized() ? 0.0 : 1.0), k8};
            case Scalar::int16:
              return {-k16 - (accessor.is_normalized() ? 0.0 : 1.0), k16};
            case Scalar::uint8:
              return {0.0, 255.0};
            default:
              return {0.0, 65535.0};
          }
        }();
        rounding_ = std::max(rounding_, 1.0 / accessor.stored(1.0));
        if (rounded >= least && rounded <= most) continue;
      }
      throw InputError(source_.path().string() + ": vertex " + std::to_string(vertex) +
                       " moved beyond what the numbers of " + accessor.where() +
                       " can say; export the file with positions of 32-bit floats, or save "
                       "another format");
    }
  }

  void move(const GltfRecords& set) {
    const Eigen::Affine3d to_local = layout_.objects[set.object].to_world.inverse();
    for (std::size_t k = 0; k < set.count(); ++k) {
      const Index v = layout_.vertex_of_record[set.first_record + k];
      if (are_same(layout_.position(set, k), mesh_.positions[v])) continue;
      const bool stays = to_local.matrix() == Eigen::Matrix4d::Identity();
      const Vector3d local = stays ? mesh_.positions[v] : to_local * mesh_.positions[v];
      require_room(set.positions, v, local);
      store(set.positions, k, local);
      moved_.insert(set.positions.number());
    }
  }

  // What one object has moved must not be another's.
  void require_unshared() const {
    std::map<std::size_t, std::size_t> object_of;
    for (const GltfRecords& set : layout_.records) {
      const auto [known, is_new] = object_of.try_emplace(set.positions.number(), set.object);
      if (!is_new && known->second != set.object && moved_.contains(set.positions.number())) {
        fail_shared(layout_.objects[known->second].name, layout_.objects[set.object].name);
      }
    }
    std::set<std::size_t> meshes;
    for (const GltfObject& object : layout_.objects) meshes.insert(object.mesh);
    const std::vector<JsonNode> all = layout_.file.root().at("meshes").elements();
    for (std::size_t m = 0; m < all.size(); ++m) {
      if (meshes.contains(m)) continue;
      for (const JsonNode& primitive : all[m].at("primitives").elements()) {
        const auto positions = primitive.at("attributes").find("POSITION");
        if (positions && moved_.contains(positions->count())) {
          fail_shared(layout_.objects[object_of.at(positions->count())].name, all[m].where());
        }
      }
    }
  }

  [[noreturn]] void fail_shared(const std::string& a, const std::string& b) const {
    throw InputError(source_.path().string() + ": '" + a + "' and '" + b +
                     "' share the positions that moved; export the file with a mesh of its own "
                     "for each object");
  }

  void turn() {
    const Positions rest = source_positions(source_, mesh_);
    const std::vector<Vector3d>& old_normals = mesh_.attributes().normals;
    const bool has_tangents = std::ranges::any_of(
        layout_.records, [](const GltfRecords& set) { return set.tangents.has_value(); });
    if (old_normals.empty() && !has_tangents) return;
    const StoredNormals updated = updated_normals(mesh_, rest);
    for (const GltfRecords& set : layout_.records) {
      if (set.normals) turn_normals(set, old_normals, updated.normals);
      if (set.tangents) turn_tangents(set, rest, updated.normals);
    }
  }

  void turn_normals(const GltfRecords& set, std::span<const Vector3d> old,
                    std::span<const Vector3d> updated) {
    const Eigen::Matrix3d to_local = layout_.objects[set.object].to_world.linear().transpose();
    for (std::size_t k = 0; k < set.count(); ++k) {
      const Index n = layout_.normal_of_record[set.first_record + k];
      if (!are_same(old[n], updated[n])) {
        store(*set.normals, k, (to_local * updated[n]).normalized());
      }
    }
  }

  void turn_tangents(const GltfRecords& set, std::span<const Vector3d> rest,
                     std::span<const Vector3d> normals) {
    const Eigen::Matrix3d to_world = layout_.objects[set.object].to_world.linear();
    const Eigen::Matrix3d to_local = to_world.inverse();
    const auto carried = carried_tangents(layout_, set, mesh_, rest, normals);
    // What did not move may still not be at right angles to its normal: that is the file's.
    const auto unmoved = touched_records(set, rest);
    for (std::size_t k = 0; k < set.count(); ++k) {
      if (!unmoved[k]) continue;
      const Vector3d local = (to_local * carried[k]).stableNormalized();
      if ((local - set.tangents->vector3(k)).norm() <= kSameDirection) continue;
      store(*set.tangents, k, local);
    }
  }

  // Those at a triangle with a corner that moved.
  std::vector<bool> touched_records(const GltfRecords& set, std::span<const Vector3d> rest) const {
    std::vector<bool> touched(set.count(), false);
    const std::vector<Index>& corners = mesh_.face_vertices();
    for (std::size_t first = 0; first + 2 < corners.size(); first += 3) {
      bool has_moved = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index v = corners[first + k];
        has_moved = has_moved || !are_same(rest[v], mesh_.positions[v]);
      }
      for (std::size_t k = 0; has_moved && k < 3; ++k) {
        const std::size_t record = layout_.record_of_corner[first + k];
        if (record >= set.first_record && record - set.first_record < set.count()) {
          touched[record - set.first_record] = true;
        }
      }
    }
    return touched;
  }

  void write_bounds() {
    const JsonText text(layout_.file.json());
    const std::vector<JsonPlace> accessors = text.elements(*text.member(text.root(), "accessors"));
    std::set<std::size_t> done;
    for (const GltfRecords& set : layout_.records) {
      const GltfAccessor& accessor = set.positions;
      if (!moved_.contains(accessor.number()) || !done.insert(accessor.number()).second) continue;
      std::array<std::string, 2> bounds{"[", "["};
      for (std::size_t c = 0; c < 3; ++c) {
        double least = stored_number(accessor, 0, c);
        double most = least;
        for (std::size_t k = 1; k < accessor.count(); ++k) {
          const double x = stored_number(accessor, k, c);
          least = std::min(least, x);
          most = std::max(most, x);
        }
        if (c > 0) {
          for (std::string& bound : bounds) bound += ',';
        }
        append_number(bounds[0], least, accessor.type());
        append_number(bounds[1], most, accessor.type());
      }
      const JsonPlace at = accessors[accessor.number()];
      if (const auto place = text.member(at, "min")) edits_.replace(*place, bounds[0] + "]");
      if (const auto place = text.member(at, "max")) edits_.replace(*place, bounds[1] + "]");
    }
  }

  void note_rounding() {
    if (rounding_ == 0.0) return;
    std::string step;
    append_number(step, static_cast<float>(rounding_));
    report_.notes.push_back("positions are whole numbers of " + step +
                            " in this file (quantized), to which those that moved were rounded");
  }

  std::vector<FileContent> files_at(const fs::path& target) {
    const bool stays = is_same_file(target, source_.path());
    std::vector<FileContent> files(1);
    std::size_t written = 0;
    const JsonText text(layout_.file.json());
    const auto list = text.member(text.root(), "buffers");
    const std::vector<JsonPlace> places = list ? text.elements(*list) : std::vector<JsonPlace>();
    for (std::size_t k = 0; k < buffers_.size(); ++k) {
      const GltfBuffer& old = layout_.file.buffers()[k];
      const auto uri = text.member(places[k], "uri");
      if (old.kind == GltfBuffer::Kind::data_uri && buffers_[k]) {
        const JsonNode node = layout_.file.root().at("buffers").element(k)->at("uri");
        const std::string head = node.string().substr(0, old.data_offset);
        edits_.replace(*uri, '"' + head + encode_base64(*buffers_[k]) + '"');
      }
      if (old.kind != GltfBuffer::Kind::file) continue;
      if (stays) {
        if (buffers_[k]) files.push_back({old.path, *buffers_[k]});
        continue;
      }
      const std::string stem = target.stem().string();
      const std::string name = stem + (written > 0 ? "-" + std::to_string(written) : "") + ".bin";
      ++written;
      edits_.replace(*uri, '"' + uri_of_path(name) + '"');
      files.push_back(
          {target.parent_path() / name, buffers_[k] ? *buffers_[k] : std::string(old.bytes)});
    }
    files[0] = {target, main_file()};
    if (!stays) note_images(target);
    return files;
  }

  std::string main_file() {
    if (!layout_.file.is_binary()) return edits_.applied_to(layout_.file.json());
    const auto& buffers = layout_.file.buffers();
    const bool has_chunk = !buffers.empty() && buffers[0].kind == GltfBuffer::Kind::chunk;
    std::string_view chunk;
    if (has_chunk) chunk = buffers_[0] ? std::string_view(*buffers_[0]) : buffers[0].bytes;
    return glb_of(edits_.applied_to(layout_.file.json()), has_chunk ? &chunk : nullptr,
                  layout_.file.further_chunks()) +
           std::string(layout_.file.tail());
  }

  void note_images(const fs::path& target) {
    const auto images = layout_.file.root().find("images");
    if (!images) return;
    for (const JsonNode& image : images->elements()) {
      const auto uri = image.find("uri");
      if (!uri || !uri->is_string() || uri->string().starts_with("data:")) continue;
      const std::string name = path_of_uri(uri->string());
      std::error_code error;
      if (fs::exists(target.parent_path() / name, error)) continue;
      report_.notes.push_back("image '" + name + "' is not beside " + target.string() +
                              "; copy it there");
    }
  }

  const SourceFile& source_;
  const GltfLayout& layout_;
  const Mesh& mesh_;
  WriteReport& report_;
  std::vector<std::optional<std::string>> buffers_;  // those that changed
  std::set<std::size_t> moved_;                      // accessors with positions that moved
  TextEdits edits_;
  double rounding_ = 0.0;
};

}  // namespace

std::vector<FileContent> patch_gltf(const SourceFile& source, const Mesh& mesh,
                                    const fs::path& target, WriteReport& report) {
  return GltfPatch(source, mesh, report).run(target);
}

}  // namespace lapwing
