#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"

namespace lapwing::bench {

/// A mesh that everything is measured on, whole, as one region. Belt: the lowest 5% of the vertices
/// in y; handle: the highest 5%.
struct Subject {
  std::string name;
  Mesh mesh;
  EditRegion region;
  double diagonal = 0.0;    ///< of the bounding box
  bool has_relief = false;  ///< a sheet of `hills`, on which patches can be chosen by number

  std::size_t vertices() const { return mesh.vertex_count(); }
  /// The handle on its way, all 12 numbers of its motion in use: at rest for `share` 0, moved by a
  /// ninth of the diagonal and turned by 17 degrees for 1.
  Eigen::Affine3d motion(double share) const;
};

/// What a settled frame of a drag may take, by the size of its mesh: 8 ms up to 50,000 vertices, 16
/// up to 250,000, then 100.
double frame_budget_ms(std::size_t vertices);

/// A handle on its way there and back, a frame at a time: one that stands still would be too easy.
class MovingHandle {
 public:
  /// There and back in a second at 60 frames a second.
  static constexpr int kFramesOfMotion = 60;

  /// `subject` must outlive it.
  explicit MovingHandle(const Subject& subject) : subject_(subject) {}
  std::array<Eigen::Affine3d, 1> next();

 private:
  const Subject& subject_;
  int frames_ = 0;
};

/// A subject that has not been made yet.
struct SubjectSource {
  std::string name;
  std::size_t vertices = 0;
  std::function<Mesh()> make;

  Subject load() const;
};

/// The meshes of a run, by size: scans of `models` (the folder that tools/setup/fetch-models
/// fills; those it lacks are left out), subdivided ones, and a sheet of generated hills at every
/// order of magnitude from 1,000 to 1,000,000 vertices.
std::vector<SubjectSource> all_subjects(const std::filesystem::path& models);

/// The square sheet of `across` x `across` vertices a unit apart, covered with hills: smooth ones
/// 30 units wide under a fine relief, the same for every size.
Mesh hills(Index across);

/// The region of a whole mesh that a Subject has.
EditRegion whole_mesh_region(const Mesh& mesh);

}  // namespace lapwing::bench
