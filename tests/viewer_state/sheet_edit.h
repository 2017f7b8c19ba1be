#pragma once

#include "coating/coating_scenes.h"
#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/run/run_recipe.h"
#include "state/draft.h"

namespace lapwing::viewer::test {

/// A sheet over the unit square, coloured, and a finer one with a relief on it, each in a folder of
/// its own.
class SheetAndRelief {
 public:
  SheetAndRelief() {
    std::filesystem::create_directories(sheet().parent_path());
    std::filesystem::create_directories(relief().parent_path());
    Mesh target = grid(12, 12);
    for (Eigen::Vector3d& p : target.positions) {
      p.z() = 0.1 * p.x() * p.x();
      target.edit_attributes().vertex_colors.emplace_back(0.5F, 0.25F, 0.75F, 1.0F);
    }
    write_mesh(target, sheet());
    write_mesh(lapwing::test::relief(24, 4.0, 0.01), relief());
  }

  std::filesystem::path sheet() const { return folder_ / "targets" / "sheet.ply"; }
  std::filesystem::path relief() const { return folder_ / "sources" / "relief.ply"; }
  std::filesystem::path folder() const { return folder_.path(); }

  /// The relief on the middle of the sheet, whose triangles stay unless `remesh` says otherwise.
  CoatStep coat(double amplitude = 1.0, Remeshing remesh = Remeshing::none) const {
    CoatStep step;
    step.source.mesh = relief();
    step.source.patch = {AllVertices{}};
    step.target_patch = {GeodesicDisk{Eigen::Vector3d(0.5, 0.5, 0.025), 0.3}};
    step.source.detail_size = 0.5;
    step.source.amplitude = amplitude;
    step.parameters.remesh = remesh;
    return step;
  }

  /// The edge at x = 1 lifted, the other held.
  static DeformRequest lift() {
    DeformRequest step;
    step.roi = {AllVertices{}};
    step.belt = RegionSpec{Box{{-1.0, -1.0, -1.0}, {0.2, 2.0, 1.0}}};
    SimilarityMove move;
    move.translate = {0.0, 0.0, 0.1};
    step.handles = {{RegionSpec{Box{{0.9, -1.0, -1.0}, {2.0, 2.0, 1.0}}}, move}};
    return step;
  }

 private:
  TemporaryFolder folder_;
};

inline bool same_mesh(const Mesh& a, const Mesh& b) {
  return a.positions == b.positions && a.face_starts() == b.face_starts() &&
         a.face_vertices() == b.face_vertices() &&
         a.attributes().vertex_colors == b.attributes().vertex_colors;
}

}  // namespace lapwing::viewer::test
