#include "lapwing/transplant/join.h"

#include <array>
#include <unordered_map>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/transplant/join_attributes.h"

namespace lapwing {
namespace {

// The loop of one mesh, with the faces at its edges and the corners of these faces.
struct Rim {
  const Mesh& mesh;
  const BoundaryLoop& loop;
  std::vector<std::array<Index, 2>> corners;  // per edge k -> k + 1: its face's corners at both
                                              // ends
  std::vector<Index> faces;                   // per edge
};

Rim find_rim(const Mesh& mesh, const BoundaryLoop& loop, const std::string& whose) {
  std::unordered_map<Index, Index> place_of;
  for (Index k = 0; k < loop.size(); ++k) place_of.emplace(loop[k], k);
  Rim rim{mesh, loop, {}, std::vector<Index>(loop.size(), kNoIndex)};
  rim.corners.resize(loop.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Index begin = mesh.face_starts()[f];
    const Index end = mesh.face_starts()[f + 1];
    for (Index c = begin; c < end; ++c) {
      const Index next = c + 1 < end ? c + 1 : begin;
      const auto from = place_of.find(mesh.face_vertices()[c]);
      if (from == place_of.end()) continue;
      const Index k = from->second;
      if (loop[(k + 1) % loop.size()] != mesh.face_vertices()[next]) continue;
      rim.corners[k] = {c, next};
      rim.faces[k] = static_cast<Index>(f);
    }
  }
  for (std::size_t k = 0; k < loop.size(); ++k) {
    if (rim.faces[k] != kNoIndex) continue;
    throw InputError("the " + whose + "'s loop goes from vertex " + std::to_string(loop[k]) +
                     " to vertex " + std::to_string(loop[(k + 1) % loop.size()]) +
                     ", but no face has that edge; use a loop from `boundary_loops`");
  }
  return rim;
}

class Joiner {
 public:
  Joiner(const Rim& host, const Rim& part, const Bridge& bridge)
      : host_(host),
        part_(part),
        zip_(bridge),
        part_of_host_(host.loop.size(), kNoIndex),
        plan_{host.mesh, part.mesh, {}, {}} {}

  Joined run(const std::string& group) {
    merge_vertices();
    Mesh& mesh = joined_.mesh;
    Faces& faces = mesh.edit_faces();
    faces = host_.mesh.faces();
    for (std::size_t f = 0; f < part_.mesh.face_count(); ++f) {
      for (const Index v : part_.mesh.face(f)) {
        faces.vertices.push_back(joined_.part_vertices[v]);
      }
      faces.starts.push_back(static_cast<Index>(faces.vertices.size()));
    }
    for (const Triangle& triangle : zip_.triangles) add_strip_face(triangle);
    mesh.edit_attributes() = join_attributes(plan_, group, joined_.notes);
    return std::move(joined_);
  }

 private:
  void merge_vertices() {
    joined_.mesh.positions = host_.mesh.positions;
    joined_.part_vertices.assign(part_.mesh.vertex_count(), kNoIndex);
    for (const auto& [at_host, at_part] : zip_.welded) {
      joined_.part_vertices[part_.loop[at_part]] = host_.loop[at_host];
      part_of_host_[at_host] = at_part;
    }
    for (Index v = 0; v < part_.mesh.vertex_count(); ++v) {
      if (joined_.part_vertices[v] != kNoIndex) continue;
      joined_.part_vertices[v] = static_cast<Index>(joined_.mesh.vertex_count());
      joined_.mesh.positions.push_back(part_.mesh.positions[v]);
      plan_.part_kept.push_back(v);
    }
  }

  // Return the position of a strip corner in one loop, or kNoIndex if it is only in the other loop.
  Index host_place(Index corner) const { return corner < host_.loop.size() ? corner : kNoIndex; }
  Index part_place(Index corner) const {
    return corner < host_.loop.size() ? part_of_host_[corner]
                                      : corner - static_cast<Index>(host_.loop.size());
  }

  void add_strip_face(const Triangle& triangle) {
    Mesh& mesh = joined_.mesh;
    std::array<Index, 3> vertices{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Index place = host_place(triangle[k]);
      vertices[k] = place != kNoIndex ? host_.loop[place]
                                      : joined_.part_vertices[part_.loop[part_place(triangle[k])]];
    }
    // The first edge of the triangle is a reversed loop edge.
    const auto count = static_cast<Index>(host_.loop.size());
    const Index first = host_place(triangle[0]);
    const Index second = host_place(triangle[1]);
    const bool on_host = first != kNoIndex && second != kNoIndex && first == (second + 1) % count;

    StripSource source;
    source.on_part = !on_host;
    const Rim& own = on_host ? host_ : part_;
    const Rim& other = on_host ? part_ : host_;
    const Index edge = on_host ? second : part_place(triangle[1]);
    const Index apex = on_host ? part_place(triangle[2]) : host_place(triangle[2]);
    source.face = own.faces[edge];
    source.corners = {own.corners[edge][1], own.corners[edge][0]};
    source.apex_corner = other.corners[apex][0];
    const auto distance = [&](std::size_t k) {
      return (mesh.positions[vertices[k]] - mesh.positions[vertices[2]]).norm();
    };
    source.nearer = distance(1) < distance(0) ? 1 : 0;
    plan_.strip.push_back(source);
    joined_.strip_faces.push_back(static_cast<Index>(mesh.face_count()));
    mesh.add_face(vertices);
  }

  const Rim& host_;
  const Rim& part_;
  const Bridge& zip_;
  std::vector<Index> part_of_host_;  // per host position: the welded part position or kNoIndex
  JoinPlan plan_;
  Joined joined_;
};

}  // namespace

Joined join(const Mesh& host, const BoundaryLoop& host_loop, const Mesh& part,
            const BoundaryLoop& part_loop, const Bridge& bridge, const std::string& group) {
  validate_attributes(host);
  validate_attributes(part);
  const Rim host_rim = find_rim(host, host_loop, "host");
  const Rim part_rim = find_rim(part, part_loop, "part");
  return Joiner(host_rim, part_rim, bridge).run(group);
}

}  // namespace lapwing
