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

/// A mesh to measure on, with the whole mesh as the region. The belt holds the lowest 5% of the
/// vertices in y, the handle the highest 5%.
struct Subject {
  std::string name;
  Mesh mesh;
  EditRegion region;
  double diagonal = 0.0;    ///< of the bounding box
  bool has_relief = false;  ///< a sheet of `hills`, on which coordinates choose patches

  std::size_t vertices() const { return mesh.vertex_count(); }
  /// Returns the handle's motion: at rest for `share` 0, moved by a ninth of the diagonal and
  /// turned by 17 degrees for 1. All 12 numbers of the motion are in use.
  Eigen::Affine3d motion(double share) const;
};

/// Returns the time budget of a settled frame of a drag, by the size of its mesh: 8 ms up to 50,000
/// vertices, 16 ms up to 250,000, then 100 ms.
double frame_budget_ms(std::size_t vertices);

/// Moves the handle there and back, frame by frame. A handle at rest would be too easy.
class MovingHandle {
 public:
  /// Frames of one motion there and back: a second at 60 frames per second.
  static constexpr int kFramesOfMotion = 60;

  /// `subject` must outlive it.
  explicit MovingHandle(const Subject& subject) : subject_(subject) {}
  std::array<Eigen::Affine3d, 1> next();

 private:
  const Subject& subject_;
  int frames_ = 0;
};

/// A subject that is not loaded yet.
struct SubjectSource {
  std::string name;
  std::size_t vertices = 0;
  std::function<Mesh()> make;

  Subject load() const;
};

/// Returns the meshes of a run, by size: scans from `models` (the folder that
/// tools/setup/fetch-models fills; missing ones are left out), subdivided scans, and sheets of
/// generated hills, one at every order of magnitude from 1,000 to 1,000,000 vertices.
std::vector<SubjectSource> all_subjects(const std::filesystem::path& models);

/// Returns the names of the scans with `least` to `most` vertices that are missing in the folder
/// `models`.
std::vector<std::string> missing_scans(const std::filesystem::path& models, std::size_t least,
                                       std::size_t most);

}  // namespace lapwing::bench
