#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/render/file_paint.h"
#include "lapwing/render/revision.h"

namespace lapwing {

class Surface;

/// What a vertex is in an edit.
enum class VertexClass : std::uint32_t { outside, roi, belt, handle };

/// The same for a vertex that a handle draws by `weight`, from 0 to 1, besides.
VertexClass drawn_by_handle(VertexClass vertex, double weight);

/// Shows in `classes`, one per vertex, how far each of `graded` goes with its handle, one of
/// `handles`, whose vertices are classed already.
void draw_graded(std::span<const GradedVertex> graded, std::span<const VertexSet> handles,
                 std::span<VertexClass> classes);

/// What each of `vertex_count` vertices is in the edit of `region`.
std::vector<VertexClass> vertex_classes(const EditRegion& region, std::size_t vertex_count);

/// Smallest and largest of some numbers.
struct ScalarRange {
  float low = 0.0F;
  float high = 0.0F;

  bool operator==(const ScalarRange&) const = default;
};

/// What one needs besides positions and normals to colour a surface: classes and numbers per
/// vertex, which triangle edges the wireframe shows, and what the mesh's file says. In device
/// memory, 4 bytes each; apart from the surface, so that it is uploaded when it changes and not
/// when the surface moves. The device must be done with it when it is changed. The surface's
/// context must outlive it.
class SurfacePaint {
 public:
  /// All vertices outside, all numbers 0, all triangle edges shown.
  explicit SurfacePaint(const Surface& surface);

  /// One per vertex of the surface; InputError otherwise.
  void set_classes(std::span<const VertexClass> classes);
  /// One per vertex of the surface; InputError otherwise. Vertices whose number is not finite are
  /// drawn without a colour.
  void set_scalars(std::span<const float> scalars);
  /// Hides the edges by which `topology` cut polygons of `mesh` into triangles. Both those of the
  /// surface; InputError otherwise.
  void set_polygons(const Mesh& mesh);

  /// What the attributes of `mesh` and its file say of the colours of `drawn`, which has the
  /// triangles of the surface, InputError otherwise; as in corner_colors. Nothing where they give
  /// no corner a colour, or where the places in images, 24 bytes a triangle, exceed a storage
  /// buffer of the device: 5.6 million triangles at 128 MiB.
  void set_file_colors(const Mesh& drawn, const Mesh& mesh, const FilePaint& file);
  bool has_file_colors() const { return corner_sources_.bytes() > 0; }

  /// Of the finite numbers; 0 and 0 if there are none.
  const ScalarRange& scalar_range() const { return scalar_range_; }

  /// Another number whenever something was set.
  std::uint64_t revision() const { return revision_.number(); }

  /// uint per vertex: the class, and above its 8 bits 255ths of the handle's weight
  const gpu::Buffer& class_buffer() const { return classes_; }
  const gpu::Buffer& scalar_buffer() const { return scalars_; }  ///< float per vertex
  /// uint per triangle: bit e is set if the edge from corner e to corner e + 1 (mod 3) is shown.
  const gpu::Buffer& edge_buffer() const { return edges_; }
  // What CornerColors and mip_levels hold; empty without colours of a file.
  const gpu::Buffer& corner_source_buffer() const { return corner_sources_; }
  const gpu::Buffer& corner_place_buffer() const { return corner_places_; }
  const gpu::Buffer& image_buffer() const { return images_; }

 private:
  gpu::Context& context_;
  std::size_t vertex_count_;
  std::size_t triangle_count_;
  gpu::Transfer transfer_;
  gpu::Buffer classes_;
  gpu::Buffer scalars_;
  gpu::Buffer edges_;
  gpu::Buffer corner_sources_;
  gpu::Buffer corner_places_;
  gpu::Buffer images_;
  ScalarRange scalar_range_;
  Revision revision_;
};

/// For each triangle, the bits of `SurfacePaint::edge_buffer`: set for edges of its polygon.
std::vector<std::uint32_t> polygon_edges(const Mesh& mesh);

/// From 0 to the number that 99 in 100 of the finite ones do not exceed: for numbers that are not
/// negative, a few of which may be so large that the others would all look alike. To the largest
/// where it is at most kOutlierFactor times as large, or where all others are 0.
ScalarRange range_without_outliers(std::span<const float> numbers);

/// Less than this makes no visible difference to the others' colours.
inline constexpr float kOutlierFactor = 1.5F;

}  // namespace lapwing
