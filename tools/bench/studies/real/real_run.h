#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lapwing::bench {

/// What one way of deforming made of a run, by measures that are the same for all: of the whole
/// region, but for `detail_error`, which is of its free vertices.
struct RealOutcome {
  bool measured = false;
  std::string failure;  ///< why nothing was measured, in words
  bool settled = true;  ///< false where the iterations ran out first
  int iterations = 0;
  std::size_t flipped_triangles = 0;
  double largest_edge = 0.0;  ///< length over length at rest of the most stretched edge
  double detail_error = 0.0;
  double edge_stretch = 0.0;  ///< root mean square of the relative change of lengths
  double prepare_ms = 0.0;
  double solve_ms = 0.0;
};

/// One motion of one mesh.
struct RealRun {
  std::string mesh;  ///< its file, below the folder that was asked for
  std::string motion;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t left_out = 0;  ///< vertices that nothing holds
  std::string failure;       ///< why there was nothing to deform; empty otherwise
  RealOutcome ours;          ///< the recipe's defaults
  RealOutcome linear;        ///< the linear response alone
  RealOutcome arap;          ///< CGAL's as-rigid-as-possible deformation
  RealOutcome smooth_arap;   ///< SmoothArap
};

/// What became of one file.
struct RealMesh {
  std::string passed_over;  ///< why it is no subject of the study; empty otherwise
  std::vector<RealRun> runs;
};

struct PassedOver {
  std::string mesh;
  std::string reason;
};

struct RealReport {
  std::string date;    ///< UTC, as in "2023-05-06T07:08:09Z"
  std::string commit;  ///< that the program was built from
  std::string processor;
  unsigned threads = 0;
  double seconds = 0.0;  ///< that it took
  std::vector<RealRun> runs;
  std::vector<PassedOver> passed_over;
};

}  // namespace lapwing::bench
