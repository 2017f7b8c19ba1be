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
  std::size_t anchor_step = 50;  ///< every so many vertices one is anchored
  bool eigen = false;
  bool busy = false;  ///< also with a processor kept busy by something else
};

/// Times the block Cholesky beside CHOLMOD and Eigen on the RSI systems of whole meshes.
void bench_solve(const SolveBench& settings);

struct OrderBench {
  std::vector<std::string> meshes;
  std::vector<std::uint32_t> hills;  ///< generated sheets of so many vertices a side
  int subdivisions = 0;              ///< of every mesh, each into four times the triangles
  int repeats = 7;
};

/// Times our nested dissection on whole meshes beside AMD and METIS, and counts what each makes of
/// the operations of the factorization.
void bench_order(const OrderBench& settings);

struct SettleBench {
  std::string device = "auto";
  std::string recipes = "tools/recipes";  ///< the folder of the four test motions
  std::string pictures;                   ///< a folder for pictures of every result, or empty
  int repeats = 7;
};

/// What settling keeps of details and lengths and what a frame costs: on three motions of a rippled
/// cylinder beside the linear solution alone and, where CGAL was there to build with, its
/// as-rigid-as-possible deformation; and on the four test motions of tools/classics.
void bench_settle(const SettleBench& settings);

struct RealBench {
  std::vector<std::string> paths{"build/models"};  ///< mesh files, and folders to search for them
  std::string only;                                ///< a part of the name of those wanted, or empty
  std::size_t most_vertices = 0;                   ///< larger meshes are passed over; 0: none
  int arap_iterations = 300;                       ///< at most, of CGAL's
  double seconds = 120.0;                          ///< that a mesh may take
  std::string show;                                ///< a file of --json: nothing is measured
  std::string json;      ///< write all runs and the summary here, or empty
  std::string markdown;  ///< write the table here, or empty
};

/// Moves one end of every mesh of at least 100 vertices in two ways (`studies/real/ends_motion.h`)
/// and measures by the same measures what the recipe's defaults, the linear response alone and
/// CGAL's as-rigid-as-possible deformation make of it; then counts what the engine is held to, and
/// names the exceptions. Each mesh has a process of its own.
void bench_real(const RealBench& settings);

struct CoatBench {
  std::size_t vertices = 10'000;       ///< of each patch, about
  std::size_t mesh_vertices = 30'000;  ///< of the generated mesh that holds both
  std::string source;                  ///< a mesh to take the source patch from, or empty
  std::string target;                  ///< likewise for the target
  double detail_size = 10.0;           ///< in mean edge lengths, of the source and of the target
  std::size_t inner_pairs = 4;
  std::vector<std::string> devices{"cpu", "auto"};
  int repeats = 7;
};

/// A coat step from one patch to another, without remeshing, by stages, on each of the devices,
/// beside what it is measured by: the target's n x n system and the two parameterizations; then
/// what a change of its amplitude and of its detail size costs, and its parts alone.
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

/// What many constraints cost: one end of a mesh is held, and the other leans by one handle, by
/// many one-vertex handles, by hard landmarks, each an edit in a process of its own; then, of the
/// mesh as it is, how long a window waits with many pins, and for another one to be taken in hand.
void bench_constraints(const ConstraintsBench& settings);

struct FollowBench {
  std::vector<std::string> meshes;
  int subdivisions = 0;    ///< of every mesh, each into four times the triangles
  double budget_ms = 0.0;  ///< of a frame; 0: frame_budget_ms
  bool at_once = false;    ///< drags begin before what is made for the first rest is there
  bool again = false;      ///< each is made ready after one with another handle and belt
};

/// Drags one end of each mesh in two ways (`studies/real/ends_motion.h`), settled frame by frame in
/// a given time, and prints what frames take and how far they are from what they would settle to:
/// while the handle moves, beside the linear response, and half a second after it has come to rest.
void bench_follow(const FollowBench& settings);

struct EditsBench {
  std::vector<std::string> meshes;
  std::vector<std::uint32_t> hills;  ///< generated sheets of so many vertices a side
  std::size_t vertices = 10'000;     ///< of a region, at most
  std::size_t count = 100;           ///< edits of each mesh
  bool settled = false;
};

/// Edits regions all over each mesh one after the other, each prepared anew, and prints what an
/// edit takes, by stages.
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

/// Shows a whole mesh by what the viewer's window draws with, on images that no display holds up,
/// and prints what each part of a frame costs where the panels alone change, where the camera moves
/// or jumps, and where a handle is dragged; and beside it where every frame draws its picture anew,
/// at full resolution and by one pipeline for all ways of looking.
void bench_frame(const FrameBench& settings);

}  // namespace lapwing::bench
