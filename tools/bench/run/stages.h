#pragma once

#include "run/bench_run.h"

namespace lapwing::bench {

/// Measures "read OBJ", "read PLY", "check" and "topology" on the processor.
void measure_mesh_stages(BenchRun& run, const Subject& subject);

/// Measures each stage of a preparation alone: "pattern", "order", "laplacian weights", "assemble"
/// (on every device), "normal matrix", "analyze", "factor", "response" (twelve columns),
/// "back-substitution" (one), and "laplacian" for the n x n system.
void measure_solver_stages(BenchRun& run, const Subject& subject);

/// Measures what a user waits for, on every device: "first drag", "preparation", "again, other
/// handle" and so on, "drag frame", "shader frame", "settle iteration", "settle frame".
void measure_edit_stages(BenchRun& run, const Subject& subject);

/// Measures "coat", "mix" and "transplant" of a ninth of the mesh, on every device, for sheets of
/// hills.
void measure_layer_stages(BenchRun& run, const Subject& subject);

/// Measures "show mesh" and "render", a picture of 1280 x 800 pixels, on every device that draws.
void measure_render(BenchRun& run, const Subject& subject);

/// Measures the same work by others: CGAL's ARAP ("preparation", "settle iteration", "settle
/// frame"), the factorizations of Eigen and CHOLMOD ("analyze", "factor", "response"), and Eigen's
/// sparse product ("normal matrix"). Leaves out libraries that the benchmark was built without.
void measure_peers(BenchRun& run, const Subject& subject);

}  // namespace lapwing::bench
