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

/// Returns `vertex` combined with the weight, from 0 to 1, by which the vertex follows a handle.
VertexClass drawn_by_handle(VertexClass vertex, double weight);

/// Adds the weights of `graded` vertices to `classes`, which has one entry per vertex. The vertices
/// of `handles` must already have the class `handle`.
void draw_graded(std::span<const FalloffVertex> graded, std::span<const VertexSet> handles,
                 std::span<VertexClass> classes);

/// Returns the class of each of `vertex_count` vertices in an edit of `region`.
std::vector<VertexClass> vertex_classes(const EditRegion& region, std::size_t vertex_count);

/// Smallest and largest scalar value.
struct ScalarRange {
  float low = 0.0F;
  float high = 0.0F;

  bool operator==(const ScalarRange&) const = default;
};

/// Data that colours a surface: a class and a scalar value per vertex, the triangle edges that the
/// wireframe shows, and the colours of the mesh's file. All are in device memory, separate from the
/// surface, and are uploaded only when they change. Before a change, the device must have finished
/// the last draw. The surface's context must outlive the object.
class SurfacePaint {
 public:
  /// Initially, all vertices have the class `outside` and the value 0, and all triangle edges are
  /// shown.
  explicit SurfacePaint(const Surface& surface);

  /// Sets one class per vertex of the surface. Throws InputError for any other number of classes.
  void set_classes(std::span<const VertexClass> classes);
  /// Sets one scalar value per vertex of the surface. Throws InputError for any other number of
  /// values. Vertices whose value is not finite are drawn without a colour.
  void set_scalars(std::span<const float> scalars);
  /// Hides the triangle edges that are diagonals of polygons of `mesh`. Throws InputError unless
  /// `mesh` has as many triangles as the surface.
  void set_polygons(const Mesh& mesh);

  /// Sets the colours of `drawn` from `mesh` and its file, as in corner_colors. Throws InputError
  /// unless `drawn` has as many triangles as the surface. Sets no colours if no corner has one, or
  /// if the texture positions, 24 bytes per triangle, exceed the largest storage buffer of the
  /// device: 5.6 million triangles for 128 MiB.
  void set_file_colors(const Mesh& drawn, const Mesh& mesh, const FilePaint& file);
  bool has_file_colors() const { return corner_sources_.bytes() > 0; }

  /// Returns the range of the finite scalar values, or [0, 0] if there are none.
  const ScalarRange& scalar_range() const { return scalar_range_; }

  /// Returns a number that changes whenever a setter is called.
  std::uint64_t revision() const { return revision_.number(); }

  /// uint per vertex: the class in the low 8 bits; above them the handle weight times 255.
  const gpu::Buffer& class_buffer() const { return classes_; }
  const gpu::Buffer& scalar_buffer() const { return scalars_; }  ///< float per vertex
  /// uint per triangle: bit e is set if the edge from corner e to corner e + 1 (mod 3) is shown.
  const gpu::Buffer& edge_buffer() const { return edges_; }
  // Contents of CornerColors and mip_levels. Empty if there are no colours of a file.
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

/// Returns the range from 0 to the 99th percentile of the finite `numbers`, which must not be
/// negative, so that a few large numbers do not make all other colours look alike. The range ends
/// at the maximum if this is at most 1.5 times the percentile, or if the percentile is 0.
ScalarRange range_without_outliers(std::span<const float> numbers);

}  // namespace lapwing
