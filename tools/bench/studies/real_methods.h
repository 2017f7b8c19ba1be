#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "studies/real/real_run.h"

namespace lapwing::bench {

struct RealLimits {
  std::size_t most_vertices = 0;  ///< larger meshes are passed over; 0 for no limit
  int arap_iterations = 300;
};

/// Runs both motions of one mesh by every method, ours first, and calls `done` with the results so
/// far after each; the last call has all. `name` is the name of the mesh in its runs. Passes over a
/// mesh that cannot be read, has no triangles, fewer than 100 vertices or too many.
void run_real_mesh(const std::filesystem::path& path, const std::string& name,
                   const RealLimits& limits, const std::function<void(const RealMesh&)>& done);

/// Shortens the message of an exception for a table. Drops what follows a semicolon, the advice.
std::string shortened(const std::string& message);

}  // namespace lapwing::bench
