#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "state/draft.h"

namespace lapwing::viewer {

/// The surfaces that the steps of a journal came to are in a file beside it: a drag that is carried
/// out again along its path ends in the same minimum, but not in the same bits.

/// Where in that file one of them is.
struct KeptResult {
  std::uint64_t start = 0;     ///< bytes
  std::uint64_t vertices = 0;  ///< how many it moves
};

/// By `result_key`.
using KeptResults = std::map<std::uint64_t, KeptResult>;

/// A hash of the steps that lead to a result, the open one included.
std::uint64_t result_key(const Draft& draft);

/// The vertices and positions of a result, 28 bytes a vertex.
std::string bytes_of(const MovedVertices& moved);

/// The result at `where` in the file `path`; nothing where that is damaged or gone.
std::optional<MovedVertices> read_result(const std::filesystem::path& path,
                                         const KeptResult& where);

}  // namespace lapwing::viewer
