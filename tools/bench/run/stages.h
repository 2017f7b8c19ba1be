#pragma once

#include "run/bench_run.h"

namespace lapwing::bench {

/// "read", "check", "topology": on the processor.
void measure_mesh_stages(BenchRun& run, const Subject& subject);

/// What a preparation is made of, each alone: "pattern", "order", "laplacian weights", "assemble"
/// (on every device), "normal matrix", "analyze", "factor", "response" (twelve columns), and of the
/// n x n system "laplacian".
void measure_solver_stages(BenchRun& run, const Subject& subject);

/// What a user waits for, on every device: "first drag", "preparation", "again, other handle"
/// and so on, "drag frame", "shader frame", "settle iteration", "settle frame".
void measure_edit_stages(BenchRun& run, const Subject& subject);

/// "coat", "mix" and "transplant" of a tenth of the mesh, on every device; only on sheets of hills.
void measure_layer_stages(BenchRun& run, const Subject& subject);

/// "show mesh" and "render", a picture of 1280 x 800 pixels of it, on every device that draws.
void measure_render(BenchRun& run, const Subject& subject);

/// The same work by others: CGAL's ARAP ("preparation", "settle iteration", "settle frame"), the
/// factorizations of Eigen and CHOLMOD ("analyze", "factor", "response"), Eigen's sparse product
/// ("normal matrix"). Nothing where they were not there to build with.
void measure_peers(BenchRun& run, const Subject& subject);

}  // namespace lapwing::bench
