#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "studies/real/real_run.h"

namespace lapwing::bench {

struct RealLimits {
  std::size_t most_vertices = 0;  ///< larger meshes are passed over; 0: none
  int arap_iterations = 300;
};

/// Does both motions of one mesh in every way, ours before the others', and calls `done` with what
/// there is after each; the last call has all. `name` is what the mesh is called in its runs. A
/// mesh that cannot be read, has no triangles, fewer than 100 vertices or too many is passed over.
void run_real_mesh(const std::filesystem::path& path, const std::string& name,
                   const RealLimits& limits, const std::function<void(const RealMesh&)>& done);

/// Words of an exception in so far as they fit in a table: without what to do about it.
std::string shortened(const std::string& message);

}  // namespace lapwing::bench
