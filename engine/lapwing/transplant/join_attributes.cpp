#include "lapwing/transplant/join_attributes.h"

#include <algorithm>
#include <array>
#include <optional>

#include <Eigen/Geometry>

namespace lapwing {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4f;

const Vector4f kWhite = Vector4f::Ones();

// Returns the index of `name` in `names`. Appends it if it is missing.
Index number_of(const std::string& name, std::vector<std::string>& names) {
  const auto at = std::ranges::find(names, name);
  const auto number = static_cast<Index>(at - names.begin());
  if (at == names.end()) names.push_back(name);
  return number;
}

void append_missing(const std::vector<std::string>& more, std::vector<std::string>& names) {
  for (const std::string& name : more) number_of(name, names);
}

class Merger {
 public:
  Merger(const JoinPlan& plan, std::vector<std::string>& notes)
      : host_(plan.host), part_(plan.part), plan_(plan), notes_(notes) {}

  MeshAttributes run(const std::string& group) {
    merge_colors();
    merge_materials();
    merge_groups(group);
    merge_uvs();
    merge_normals();
    merge_extras();
    result_.comments = host_.attributes().comments;
    append_missing(part_.attributes().comments, result_.comments);
    note_uneditable(host_, "host");
    note_uneditable(part_, "part");
    return std::move(result_);
  }

 private:
  // Adds a note if only one mesh has the attribute. Returns whether either has it.
  bool note_one_sided(bool on_host, bool on_part, const std::string& what,
                      const std::string& instead) {
    if (on_host != on_part) {
      notes_.push_back("the " + std::string(on_host ? "part" : "host") + " has no " + what + ": " +
                       instead);
    }
    return on_host || on_part;
  }

  // Returns `components` values per vertex, first of the host, then of the part's vertices that
  // were not welded.
  template <class Value>
  std::vector<Value> per_vertex(const std::vector<Value>& of_host,
                                const std::vector<Value>& of_part, const Value& neutral,
                                std::size_t components = 1) const {
    std::vector<Value> merged = of_host;
    merged.resize(host_.vertex_count() * components, neutral);
    for (const Index v : plan_.part_kept) {
      for (std::size_t k = 0; k < components; ++k) {
        merged.push_back(of_part.empty() ? neutral : of_part[v * components + k]);
      }
    }
    return merged;
  }

  // Returns `components` values per face of host, part and strip. A strip face copies the values of
  // the mesh face at its loop edge.
  template <class Value>
  std::vector<Value> per_face(const std::vector<Value>& of_host, const std::vector<Value>& of_part,
                              const Value& neutral, std::size_t components = 1) const {
    std::vector<Value> merged = of_host;
    merged.resize(host_.face_count() * components, neutral);
    merged.insert(merged.end(), of_part.begin(), of_part.end());
    merged.resize((host_.face_count() + part_.face_count()) * components, neutral);
    for (const StripSource& source : plan_.strip) {
      const std::vector<Value>& own = source.on_part ? of_part : of_host;
      for (std::size_t k = 0; k < components; ++k) {
        merged.push_back(own.empty() ? neutral : own[source.face * components + k]);
      }
    }
    return merged;
  }

  void merge_colors() {
    const MeshAttributes& a = host_.attributes();
    const MeshAttributes& b = part_.attributes();
    if (note_one_sided(!a.vertex_colors.empty(), !b.vertex_colors.empty(), "vertex colours",
                       "its vertices are white")) {
      result_.vertex_colors = per_vertex(a.vertex_colors, b.vertex_colors, kWhite);
    }
    if (note_one_sided(!a.face_colors.empty(), !b.face_colors.empty(), "face colours",
                       "its faces are white")) {
      result_.face_colors = per_face(a.face_colors, b.face_colors, kWhite);
    }
  }

  void merge_materials() {
    const MeshAttributes& a = host_.attributes();
    const MeshAttributes& b = part_.attributes();
    result_.material_libraries = a.material_libraries;
    append_missing(b.material_libraries, result_.material_libraries);
    result_.materials = a.materials;
    std::vector<Index> number;
    for (const std::string& name : b.materials) {
      number.push_back(number_of(name, result_.materials));
      if (number.back() < a.materials.size() && a.material_libraries != b.material_libraries) {
        notes_.push_back("material '" + name +
                         "' is in host and part, which use different libraries: both get the "
                         "first definition with that name");
      }
    }
    if (!note_one_sided(!a.face_materials.empty(), !b.face_materials.empty(), "materials",
                        "its faces have none")) {
      return;
    }
    result_.face_materials =
        per_face(a.face_materials, renumbered(b.face_materials, number), kNoIndex);
  }

  static std::vector<Index> renumbered(std::vector<Index> values, std::span<const Index> number) {
    for (Index& value : values) {
      if (value != kNoIndex) value = number[value];
    }
    return values;
  }

  void merge_groups(const std::string& group) {
    const MeshAttributes& a = host_.attributes();
    const MeshAttributes& b = part_.attributes();
    result_.groups = a.groups;
    std::vector<Index> number;
    Index whole = kNoIndex;
    if (!group.empty()) whole = number_of(group, result_.groups);
    for (const std::string& own : b.groups) {
      number.push_back(number_of(group.empty() ? own : group + "/" + own, result_.groups));
    }
    if (group.empty() && a.face_groups.empty() && b.face_groups.empty()) return;
    std::vector<Index> of_part = renumbered(b.face_groups, number);
    of_part.resize(part_.face_count(), kNoIndex);
    std::ranges::replace(of_part, kNoIndex, whole);
    result_.face_groups = per_face(a.face_groups, of_part, kNoIndex);
    if (group.empty()) return;
    std::fill(result_.face_groups.end() - static_cast<std::ptrdiff_t>(plan_.strip.size()),
              result_.face_groups.end(), whole);
  }

  // Returns the indices per corner of both meshes. `offset` is added to the part's indices.
  std::vector<Index> per_corner(std::vector<Index> of_host, std::span<const Index> of_part,
                                std::size_t offset) const {
    std::vector<Index> merged = std::move(of_host);
    merged.resize(host_.face_vertices().size(), kNoIndex);
    for (const Index number : of_part) {
      merged.push_back(number == kNoIndex ? kNoIndex : static_cast<Index>(offset) + number);
    }
    merged.resize(host_.face_vertices().size() + part_.face_vertices().size(), kNoIndex);
    return merged;
  }

  // Returns the entry of `merged` for a corner of one of the meshes.
  Index at(const std::vector<Index>& merged, bool on_part, Index corner) const {
    return merged[(on_part ? host_.face_vertices().size() : 0) + corner];
  }

  void merge_uvs() {
    const MeshAttributes& a = host_.attributes();
    const MeshAttributes& b = part_.attributes();
    result_.uvs = a.uvs;
    result_.uvs.insert(result_.uvs.end(), b.uvs.begin(), b.uvs.end());
    if (!note_one_sided(!a.corner_uvs.empty(), !b.corner_uvs.empty(), "texture coordinates",
                        "its faces have none")) {
      return;
    }
    std::vector<Index>& merged = result_.corner_uvs;
    merged = per_corner(a.corner_uvs, b.corner_uvs, a.uvs.size());
    for (const StripSource& source : plan_.strip) {
      const Index first = at(merged, source.on_part, source.corners[0]);
      const Index second = at(merged, source.on_part, source.corners[1]);
      const bool whole = first != kNoIndex && second != kNoIndex;
      for (const Index uv : {first, second, source.nearer == 0 ? first : second}) {
        merged.push_back(whole ? uv : kNoIndex);
      }
    }
  }

  static bool has_normals(const MeshAttributes& a) {
    return a.has_vertex_normals || !a.corner_normals.empty();
  }

  // Returns the area-weighted mean normals of the faces around each vertex.
  static std::vector<Vector3d> face_means(const Mesh& mesh) {
    std::vector<Vector3d> sums(mesh.vertex_count(), Vector3d::Zero());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      Vector3d area = Vector3d::Zero();
      for (std::size_t k = 2; k < face.size(); ++k) {
        const Vector3d& origin = mesh.positions[face[0]];
        area += (mesh.positions[face[k - 1]] - origin).cross(mesh.positions[face[k]] - origin);
      }
      for (const Index v : face) sums[v] += area;
    }
    for (Vector3d& sum : sums) sum.normalize();
    return sums;
  }

  void merge_normals() {
    const MeshAttributes& a = host_.attributes();
    const MeshAttributes& b = part_.attributes();
    const bool per_corner_somewhere =
        (has_normals(a) && !a.has_vertex_normals) || (has_normals(b) && !b.has_vertex_normals);
    if (!note_one_sided(
            has_normals(a), has_normals(b), "normals",
            per_corner_somewhere ? "its corners have none" : "they are averaged from its faces")) {
      return;
    }
    if (per_corner_somewhere) {
      merge_corner_normals();
      return;
    }
    result_.has_vertex_normals = true;
    result_.normals =
        per_vertex(has_normals(a) ? a.normals : face_means(host_),
                   has_normals(b) ? b.normals : face_means(part_), Vector3d(Vector3d::Zero()));
  }

  void merge_corner_normals() {
    const auto corners = [](const Mesh& mesh) {
      return mesh.attributes().has_vertex_normals ? mesh.face_vertices()
                                                  : mesh.attributes().corner_normals;
    };
    result_.normals = host_.attributes().normals;
    result_.normals.insert(result_.normals.end(), part_.attributes().normals.begin(),
                           part_.attributes().normals.end());
    std::vector<Index>& merged = result_.corner_normals;
    merged = per_corner(corners(host_), corners(part_), host_.attributes().normals.size());
    for (const StripSource& source : plan_.strip) {
      const Index first = at(merged, source.on_part, source.corners[0]);
      const Index second = at(merged, source.on_part, source.corners[1]);
      const Index apex = at(merged, !source.on_part, source.apex_corner);
      merged.insert(merged.end(), {first, second, apex});
    }
  }

  void merge_extras() {
    result_.vertex_extras = merged_extras(
        host_.attributes().vertex_extras, part_.attributes().vertex_extras, "vertex property",
        [this](const auto& a, const auto& b, std::size_t n) { return per_vertex(a, b, 0.0, n); });
    result_.face_extras = merged_extras(
        host_.attributes().face_extras, part_.attributes().face_extras, "face property",
        [this](const auto& a, const auto& b, std::size_t n) { return per_face(a, b, 0.0, n); });
  }

  template <class Merge>
  std::vector<ExtraAttribute> merged_extras(const std::vector<ExtraAttribute>& of_host,
                                            const std::vector<ExtraAttribute>& of_part,
                                            const std::string& kind, const Merge& merge) {
    std::vector<ExtraAttribute> result;
    const auto add = [&](const ExtraAttribute& like, const ExtraAttribute* a,
                         const ExtraAttribute* b) {
      const std::vector<double> none;
      note_one_sided(a != nullptr, b != nullptr, kind + " '" + like.name + "'", "it is 0 there");
      result.push_back({like.name, like.type, like.components,
                        merge(a ? a->values : none, b ? b->values : none,
                              static_cast<std::size_t>(like.components))});
    };
    for (const ExtraAttribute& extra : of_host) {
      const auto same = std::ranges::find(of_part, extra.name, &ExtraAttribute::name);
      const bool fits = same != of_part.end() && same->components == extra.components;
      if (same != of_part.end() && !fits) {
        notes_.push_back(kind + " '" + extra.name + "' has " + std::to_string(extra.components) +
                         " components on the host and " + std::to_string(same->components) +
                         " on the part: the part's values are dropped");
      }
      add(extra, &extra, fits ? &*same : nullptr);
    }
    for (const ExtraAttribute& extra : of_part) {
      const auto same = std::ranges::find(of_host, extra.name, &ExtraAttribute::name);
      if (same == of_host.end()) add(extra, nullptr, &extra);
    }
    return result;
  }

  void note_uneditable(const Mesh& mesh, const std::string& whose) {
    for (const std::string& what : mesh.attributes().uneditable) {
      notes_.push_back("left out of the " + whose + ": " + what);
    }
  }

  const Mesh& host_;
  const Mesh& part_;
  const JoinPlan& plan_;
  std::vector<std::string>& notes_;
  MeshAttributes result_;
};

}  // namespace

MeshAttributes join_attributes(const JoinPlan& plan, const std::string& group,
                               std::vector<std::string>& notes) {
  return Merger(plan, notes).run(group);
}

}  // namespace lapwing
