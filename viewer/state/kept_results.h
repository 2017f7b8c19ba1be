#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "state/draft.h"

namespace lapwing::viewer {

// Each journal has a results file, which stores the settled surfaces of its deforms. They are
// stored because recomputing a drag does not always give bitwise identical positions.

/// The place of one result in the results file.
struct KeptResult {
  std::uint64_t start = 0;     ///< bytes
  std::uint64_t vertices = 0;  ///< number of vertices that it moves
};

/// Keyed by `result_key`.
using KeptResults = std::map<std::uint64_t, KeptResult>;

/// Identifies a result: a hash of the steps that lead to it, including the open one.
std::uint64_t result_key(const Draft& draft);

/// The vertices and positions of a result as bytes, 28 per vertex.
std::string bytes_of(const MovedVertices& moved);

/// Reads a result. Returns nothing if the file is damaged or missing.
std::optional<MovedVertices> read_result(const std::filesystem::path& path,
                                         const KeptResult& where);

}  // namespace lapwing::viewer
