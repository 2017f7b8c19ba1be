#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lapwing::bench {

struct SolveBench {
  std::vector<std::string> meshes;
  int subdivisions = 0;  ///< of every mesh, each into four times the triangles
  int repeats = 7;
  std::vector<unsigned> threads{2, 1};
  std::size_t anchor_step = 50;  ///< one vertex in so many is anchored
  bool eigen = false;
  bool busy = false;  ///< also with one processor kept busy
};

/// Compares the block Cholesky with CHOLMOD and Eigen on the RSI systems of whole meshes.
void bench_solve(const SolveBench& settings);

struct OrderBench {
  std::vector<std::string> meshes;
  std::vector<std::uint32_t> hills;  ///< vertices per side of generated sheets
  int subdivisions = 0;              ///< of every mesh, each into four times the triangles
  int repeats = 7;
};

/// Compares our nested dissection with AMD and METIS on whole meshes: the time of each, and the
/// operations of the factorization that follows.
void bench_order(const OrderBench& settings);

struct SettleBench {
  std::string device = "auto";
  std::string recipes = "tools/recipes";  ///< the folder of the four test motions
  std::string pictures;                   ///< a folder for pictures of every result, or empty
  int repeats = 7;
};

/// Measures how well settling keeps details and lengths, and what a frame costs. Uses three motions
/// of a rippled cylinder, also solved by the linear response alone and, if built with CGAL, by
/// as-rigid-as-possible deformation, and the four test motions of tools/classics.
void bench_settle(const SettleBench& settings);

struct RealBench {
  std::vector<std::string> paths{"build/models"};  ///< mesh files, and folders to search for them
  std::string only;                                ///< only meshes with this in their names
  std::size_t most_vertices = 0;                   ///< larger meshes are passed over; 0: no limit
  int arap_iterations = 300;                       ///< maximum for both ARAP methods
  double seconds = 120.0;                          ///< time limit of a mesh
  std::string show;                                ///< a file of --json to show; measures nothing
  std::string json;      ///< write all runs and the summary here, or empty
  std::string markdown;  ///< write the table here, or empty
};

/// Moves one end of every mesh of at least 100 vertices in two ways (`studies/real/ends_motion.h`).
/// Measures the results of the recipe's defaults, the linear response alone, CGAL's
/// as-rigid-as-possible deformation and Smooth ARAP in the same way. Then counts the runs that meet
/// the engine's targets and names the exceptions. Each mesh runs in a separate process.
void bench_real(const RealBench& settings);

struct CoatBench {
  std::size_t vertices = 10'000;       ///< of each patch, approximately
  std::size_t mesh_vertices = 30'000;  ///< of the generated mesh that holds both
  std::string source;                  ///< a mesh to take the source patch from, or empty
  std::string target;                  ///< likewise for the target
  double detail_size = 10.0;           ///< in mean edge lengths, of the source and of the target
  std::size_t inner_pairs = 4;
  std::vector<std::string> devices{"cpu", "auto"};
  int repeats = 7;
};

/// Times a coat step from one patch to another, without remeshing, by stages and on each device.
/// Its reference is the target's n x n system and the two parameterizations. Then times a change of
/// its amplitude and of its detail size, and each of its parts alone.
void bench_coat(const CoatBench& settings);

struct ConstraintsBench {
  std::string mesh;
  int subdivisions = 0;  ///< of it, each into four times the triangles
  bool rounded = false;  ///< by Loop's scheme
  std::size_t handles = 1000;
  std::size_t landmarks = 2000;
  std::size_t window_handles = 200;
  int repeats = 7;
};

/// Measures the cost of many constraints. One end of a mesh is held, and the other leans by one
/// handle, by many one-vertex handles or by hard landmarks, each in a separate process. Without
/// subdivision it then measures how long a window waits with many pins, and for a drag of another
/// pin.
void bench_constraints(const ConstraintsBench& settings);

struct FollowBench {
  std::vector<std::string> meshes;
  int subdivisions = 0;    ///< of every mesh, each into four times the triangles
  double budget_ms = 0.0;  ///< of a frame; 0: frame_budget_ms
  bool at_once = false;    ///< starts drags before background work for the rest is done
  bool again = false;      ///< prepares each drag after one with another handle and belt
};

/// Drags one end of each mesh in two ways (`studies/real/ends_motion.h`), settled frame by frame in
/// a given time. Prints the times of frames and their distances from the settled surface: while the
/// handle moves, beside the linear response, and half a second after it has come to rest.
void bench_follow(const FollowBench& settings);

struct EditsBench {
  std::vector<std::string> meshes;
  std::vector<std::uint32_t> hills;  ///< vertices per side of generated sheets
  std::size_t vertices = 10'000;     ///< of a region, at most
  std::size_t count = 100;           ///< edits of each mesh
  bool settled = false;
};

/// Edits regions all over each mesh, each prepared separately, and prints the times of the stages.
void bench_edits(const EditsBench& settings);

struct FrameBench {
  std::string mesh;
  int subdivisions = 0;  ///< of it, each into four times the triangles
  std::string device = "auto";
  std::uint32_t width = 1280;  ///< in pixels
  std::uint32_t height = 800;  ///< in pixels
  int repeats = 7;
  std::string picture;  ///< a PNG of the last frame, or empty
};

/// Draws a whole mesh offscreen, as the viewer's window does. Prints the cost of each part of a
/// frame when only the panels change, when the camera moves or jumps, and when a handle is dragged.
/// Also measures frames that always redraw their picture, and frames at full resolution with one
/// pipeline for all styles.
void bench_frame(const FrameBench& settings);

}  // namespace lapwing::bench
