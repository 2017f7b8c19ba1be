#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "state/draft.h"

namespace lapwing::viewer {

// Each journal has a results file, which stores the settled surfaces of its deforms, because
// recomputing a drag does not always result in bitwise identical positions.

/// The position of one result in the results file.
struct KeptResult {
  std::uint64_t start = 0;     ///< offset in bytes
  std::uint64_t vertices = 0;  ///< number of moved vertices
};

/// Maps the `result_key` of each result to its position.
using KeptResults = std::map<std::uint64_t, KeptResult>;

/// Returns a hash of the steps that lead to a result, including the open step.
std::uint64_t result_key(const Draft& draft);

/// Returns the vertices and positions of a result as bytes, 28 per vertex.
std::string bytes_of(const MovedVertices& moved);

/// Reads a result. Returns nullopt if the file is damaged or missing.
std::optional<MovedVertices> read_result(const std::filesystem::path& path,
                                         const KeptResult& where);

}  // namespace lapwing::viewer
