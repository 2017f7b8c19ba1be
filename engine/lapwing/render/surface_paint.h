#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/render/mip_levels.h"
#include "lapwing/render/revision.h"

namespace lapwing {

class Surface;

/// Role of a vertex in an edit.
enum class VertexClass : std::uint32_t { outside, roi, belt, handle };

/// Returns `vertex` with the weight, from 0 to 1, by which a handle draws it.
VertexClass drawn_by_handle(VertexClass vertex, double weight);

/// Adds to `classes`, one per vertex, the weights by which `graded` vertices follow their handles.
/// The vertices of `handles` must already have their class.
void draw_graded(std::span<const FalloffVertex> graded, std::span<const VertexSet> handles,
                 std::span<VertexClass> classes);

/// Returns the class of each of `vertex_count` vertices in the edit of `region`.
std::vector<VertexClass> vertex_classes(const EditRegion& region, std::size_t vertex_count);

/// Smallest and largest of some numbers.
struct ScalarRange {
  float low = 0.0F;
  float high = 0.0F;

  bool operator==(const ScalarRange&) const = default;
};

/// Data that colours a surface, besides positions and normals: classes and numbers per vertex, the
/// triangle edges that the wireframe shows, and the colours of the mesh's file. It is in device
/// memory, 4 bytes each, apart from the surface, so that it is uploaded only when it changes. The
/// device must have finished with it before it changes. The surface's context must outlive it.
class SurfacePaint {
 public:
  /// Starts with all vertices outside, all numbers 0 and all triangle edges shown.
  explicit SurfacePaint(const Surface& surface);

  /// Sets one class per vertex of the surface. Throws InputError for any other number of them.
  void set_classes(std::span<const VertexClass> classes);
  /// Sets one number per vertex of the surface. Throws InputError for any other count. Vertices
  /// whose number is not finite are drawn without a colour.
  void set_scalars(std::span<const float> scalars);
  /// Hides the edges that cut polygons of `mesh` into triangles. Throws InputError if its number of
  /// triangles differs from that of the surface.
  void set_polygons(const Mesh& mesh);

  /// Sets the colours that `mesh` and its file give `drawn`, as in corner_colors. Throws InputError
  /// unless `drawn` has as many triangles as the surface. Sets none if no corner has a colour, or
  /// if the positions in images, 24 bytes per triangle, exceed a storage buffer of the device: 5.6
  /// million triangles at 128 MiB.
  void set_file_colors(const Mesh& drawn, const Mesh& mesh, const FilePaint& file);
  bool has_file_colors() const { return corner_sources_.bytes() > 0; }

  /// Returns the range of the finite numbers; 0 and 0 if there are none.
  const ScalarRange& scalar_range() const { return scalar_range_; }

  /// Returns a number that changes whenever something is set.
  std::uint64_t revision() const { return revision_.number(); }

  /// uint per vertex: the class in the low 8 bits, the handle's weight in 255ths above.
  const gpu::Buffer& class_buffer() const { return classes_; }
  const gpu::Buffer& scalar_buffer() const { return scalars_; }  ///< float per vertex
  /// uint per triangle: bit e is set if the edge from corner e to corner e + 1 (mod 3) is shown.
  const gpu::Buffer& edge_buffer() const { return edges_; }
  // Contents of CornerColors and mip_levels; empty without colours of a file.
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

/// Returns the range from 0 to the 99th percentile of the finite numbers, which must not be
/// negative. This prevents a few large numbers from making all other colours look alike. The range
/// ends at the maximum if that is at most 1.5 times the percentile, or if the percentile is 0.
ScalarRange range_without_outliers(std::span<const float> numbers);

}  // namespace lapwing
