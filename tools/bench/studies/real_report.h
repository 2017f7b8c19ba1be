#pragma once

#include <cstddef>
#include <string>
#include <string_view>
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
  /// The largest distance of a vertex of the belt or the handle from its prescribed position, over
  /// the largest prescribed displacement. 0 if the constraints are exact.
  double constraint_error = 0.0;
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

/// A run or a file that the report lists, and the reason for listing it.
struct Noted {
  std::string name;  ///< for example "cgal/meshes/cow.off lift"
  std::string why;
};

struct RealReport {
  std::string date;    ///< UTC, as in "2023-05-06T07:08:09Z"
  std::string commit;  ///< source revision of the program
  std::string processor;
  unsigned threads = 0;
  double seconds = 0.0;  ///< duration of the study
  std::vector<RealRun> runs;
  std::vector<Noted> passed_over;  ///< files that were not measured
};

/// A target of the engine: the number of runs in which a condition holds, and its bound.
struct RealFigure {
  std::string name;
  std::string target;    ///< `bound` in words
  bool is_floor = true;  ///< whether `bound` is a lower or an upper bound
  double bound = 0.0;    ///< in runs
  std::size_t count = 0;
  std::size_t of = 0;  ///< number of runs that were checked
  std::vector<Noted> exceptions = {};

  bool met() const;  ///< also false if there are no runs
};

struct RealSummary {
  std::size_t meshes = 0;
  std::size_t runs = 0;
  std::size_t compared = 0;  ///< number of runs with results of Lapwing and of ARAP
  std::vector<RealFigure> figures;
  std::vector<Noted> failures;  ///< runs in which a method failed
};

/// Compares our results with ARAP's if both exist. Detail errors within 1e-6 are equal. If ours
/// failed, the run does not count as settled.
RealSummary summary_of(const std::vector<RealRun>& runs);

/// Returns the two heading lines of a table of `line_of`.
std::string real_heading();

/// Returns one run as a line of 100 columns. If results are missing, a second line gives the
/// reasons. A star means that a method reached its maximum number of iterations.
std::string line_of(const RealRun& run);

/// Returns the summary for a terminal: figures with exceptions, totals of each method, failures and
/// files passed over.
std::string text_of(const RealReport& report);

/// Writes the report as JSON of format "lapwing-bench real 3", one run per line, with the summary,
/// which is not read back. Numbers have six significant digits.
std::string to_json(const RealReport& report);

/// Parses a report that to_json wrote. If the text is not a report, throws an InputError that gives
/// `name` as the file name.
RealReport parse_real_report(std::string_view json, const std::string& name);

/// Returns the JSON text of one mesh, in one line.
std::string to_json_line(const RealMesh& mesh);
RealMesh parse_real_mesh(std::string_view json);

}  // namespace lapwing::bench
