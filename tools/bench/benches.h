#pragma once

#include <filesystem>
#include <string>

namespace lapwing::bench {

/// Reads a generated mesh of `vertices` vertices as OBJ and as binary PLY, and prints MB/s.
void bench_read(std::size_t vertices, int repeats);

/// Prepares and drags `mesh` as a whole (belt: the lowest 5% of the vertices in y; handle: the
/// highest 5%, moved by 20% of the diagonal), and prints each stage beside what the same work costs
/// in Eigen and CHOLMOD.
void bench_deform(const std::filesystem::path& mesh, const std::string& device, int repeats);

}  // namespace lapwing::bench
