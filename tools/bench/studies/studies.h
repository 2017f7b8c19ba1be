#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lapwing::bench {

struct RealBench {
  std::vector<std::string> paths{"build/models"};  ///< mesh files, and folders to search for them
  std::string only;                                ///< only meshes with this in their names
  std::size_t most_vertices = 0;                   ///< larger meshes are passed over; 0: no limit
  int arap_iterations = 300;  ///< maximum number of iterations, also of Smooth ARAP
  double seconds = 120.0;                          ///< time limit of a mesh
  std::string show;                                ///< a file of --json to show; measures nothing
  std::string json;  ///< output file for all runs and the summary; empty: none
};

/// Moves one end of every mesh that has at least 100 vertices by two motions
/// (`studies/ends_motion.h`). Computes the same measures for four results: that of a recipe with
/// default settings, the linear response without settling, CGAL's as-rigid-as-possible deformation,
/// and SmoothArap. Then counts the runs that meet the engine's targets and lists the exceptions.
/// Each mesh runs in a separate process.
void bench_real(const RealBench& settings);

struct ConstraintsBench {
  std::string mesh;
  int subdivisions = 0;  ///< of it, each into four times the triangles
  std::size_t handles = 1000;
  std::size_t landmarks = 2000;
};

/// Measures the cost of many constraints. One end of a mesh is fixed, and the other end is tilted
/// by one handle, by many handles of one vertex each, or by hard landmarks. Each edit runs in a
/// separate process.
void bench_constraints(const ConstraintsBench& settings);

struct FollowBench {
  std::vector<std::string> meshes;
  int subdivisions = 0;    ///< of every mesh, each into four times the triangles
  double budget_ms = 0.0;  ///< of a frame; 0: frame_budget_ms
  std::string device;      ///< compares its frames with their CPU twin; empty: none
};

/// Drags one end of each mesh by two motions (`studies/ends_motion.h`) with a time budget per
/// frame. Prints the times of the frames and their distances from the settled surface, and the same
/// for the linear response. Measures during the motion and half a second after its end.
void bench_follow(const FollowBench& settings);

struct FrameBench {
  std::string mesh;
  std::string device = "auto";
  std::uint32_t width = 1280;  ///< in pixels
  std::uint32_t height = 800;  ///< in pixels
  int repeats = 7;
};

/// Opens the mesh in the viewer, which draws offscreen. Prints the cost of each part of a frame,
/// both while the cursor moves over the panels and while a mouse drag rotates the view.
void bench_frame(const FrameBench& settings);

}  // namespace lapwing::bench
