#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lapwing::bench {

/// The result of one method in a run, measured in the same way for all methods: over the whole
/// region, except `detail_error`, which covers its free vertices.
struct RealOutcome {
  bool measured = false;
  std::string failure;  ///< why nothing was measured
  bool settled = true;  ///< false if the iterations ran out first
  int iterations = 0;
  std::size_t flipped_triangles = 0;
  double largest_edge = 0.0;  ///< length over rest length of the most stretched edge
  double detail_error = 0.0;
  double edge_stretch = 0.0;  ///< root mean square of the relative change of lengths
  double prepare_ms = 0.0;
  double solve_ms = 0.0;
};

/// One motion of one mesh.
struct RealRun {
  std::string mesh;  ///< its file, relative to the given folder
  std::string motion;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t left_out = 0;  ///< number of vertices outside the held region
  std::string failure;       ///< why there was nothing to deform; empty otherwise
  RealOutcome ours;          ///< the recipe's defaults
  RealOutcome linear;        ///< the linear response alone
  RealOutcome arap;          ///< CGAL's as-rigid-as-possible deformation
  RealOutcome smooth_arap;   ///< SmoothArap
};

/// The result of one file.
struct RealMesh {
  std::string passed_over;  ///< why the study passes it over; empty otherwise
  std::vector<RealRun> runs;
};

struct PassedOver {
  std::string mesh;
  std::string reason;
};

struct RealReport {
  std::string date;    ///< UTC, as in "2023-05-06T07:08:09Z"
  std::string commit;  ///< source revision of the program
  std::string processor;
  unsigned threads = 0;
  double seconds = 0.0;  ///< duration of the study
  std::vector<RealRun> runs;
  std::vector<PassedOver> passed_over;
};

}  // namespace lapwing::bench
