#include "lapwing/render/corner_colors.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

using Place = std::array<float, 2>;

std::uint32_t word_of(const Eigen::Vector3f& srgb) {
  std::uint32_t word = 0;
  for (Eigen::Index c = 2; c >= 0; --c) {
    const float byte = 255.0F * std::clamp(srgb[c], 0.0F, 1.0F);
    word = word << 8U | static_cast<std::uint32_t>(std::lround(byte));
  }
  return static_cast<std::uint32_t>(CornerSource::color) | word;
}

// Returns the polygon's corners at the vertices of `triangle`, one of its triangles. If the polygon
// visits a vertex twice, returns the first corner at that vertex.
std::array<Index, 3> corners_of(const Mesh& drawn, Index face, const Triangle& triangle) {
  const std::span<const Index> polygon = drawn.face(face);
  std::array<Index, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = drawn.face_starts()[face] +
                 static_cast<Index>(std::ranges::find(polygon, triangle[k]) - polygon.begin());
  }
  return corners;
}

class CornerPainter {
 public:
  CornerPainter(const Mesh& drawn, const Mesh& mesh, const FileColors& colors)
      : drawn_(drawn),
        mesh_(mesh),
        attributes_(mesh.attributes()),
        colors_(colors),
        materials_(materials_of_faces(colors, mesh)) {}

  CornerColors run() {
    const Topology& topology = drawn_.topology();
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
      paint(topology.triangle_faces[t], topology.triangles[t]);
    }
    const auto none = static_cast<std::uint32_t>(CornerSource::none);
    if (std::ranges::all_of(result_.sources, [&](std::uint32_t s) { return s == none; })) {
      result_.sources.clear();
    }
    if (!has_images_) result_.places.clear();
    return std::move(result_);
  }

 private:
  void paint(Index face, const Triangle& triangle) {
    const FileMaterial* const material = materials_.empty() || materials_[face] == kNoIndex
                                             ? nullptr
                                             : &colors_.materials[materials_[face]];
    const std::array<Index, 3> corners = corners_of(drawn_, face, triangle);
    if (const auto places = find_places(material, corners)) {
      has_images_ = true;
      for (const Place& place : *places) {
        add(static_cast<std::uint32_t>(CornerSource::image) | material->image, place);
      }
      return;
    }
    for (const Index corner : corners) add(color_of(corner, face, material), {});
  }

  void add(std::uint32_t source, const Place& place) {
    result_.sources.push_back(source);
    result_.places.push_back(place);
  }

  std::uint32_t color_of(Index corner, Index face, const FileMaterial* material) const {
    if (!attributes_.vertex_colors.empty()) {
      return word_of(attributes_.vertex_colors[mesh_.face_vertices()[corner]].head<3>());
    }
    if (!attributes_.face_colors.empty()) return word_of(attributes_.face_colors[face].head<3>());
    if (material != nullptr && material->color) return word_of(*material->color);
    return static_cast<std::uint32_t>(CornerSource::none);
  }

  // Returns the positions of the corners in the image of `material`. Returns nothing if the
  // material has no image or a corner has no texture coordinates.
  std::optional<std::array<Place, 3>> find_places(const FileMaterial* material,
                                                  const std::array<Index, 3>& corners) const {
    if (material == nullptr || material->image == kNoIndex || attributes_.corner_uvs.empty()) {
      return {};
    }
    std::array<Eigen::Vector2d, 3> wide;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index uv = attributes_.corner_uvs[corners[k]];
      if (uv == kNoIndex) return {};
      const Eigen::Vector2d at =
          material->uv_scale.cwiseProduct(attributes_.uvs[uv]) + material->uv_offset;
      wide[k] = {at.x(), 1.0 - at.y()};
      if (!wide[k].allFinite()) return {};
    }
    const Eigen::Vector2d whole = wide[0].cwiseMin(wide[1]).cwiseMin(wide[2]).array().floor();
    std::array<Place, 3> places;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2d near = wide[k] - whole;
      places[k] = {static_cast<float>(near.x()), static_cast<float>(near.y())};
    }
    return places;
  }

  const Mesh& drawn_;
  const Mesh& mesh_;
  const MeshAttributes& attributes_;
  const FileColors& colors_;
  std::vector<Index> materials_;
  CornerColors result_;
  bool has_images_ = false;
};

}  // namespace

CornerColors corner_colors(const Mesh& drawn, const Mesh& mesh, const FileColors& colors) {
  const MeshAttributes& a = mesh.attributes();
  if (colors.materials.empty() && a.vertex_colors.empty() && a.face_colors.empty()) return {};
  if (!drawn.shares_faces_with(mesh) && drawn.face_starts() != mesh.face_starts()) return {};
  return CornerPainter(drawn, mesh, colors).run();
}

}  // namespace lapwing
