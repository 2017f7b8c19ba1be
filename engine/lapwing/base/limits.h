#pragma once

#include <cstddef>
#include <string>

namespace lapwing {

/// How much one operation may make. Before it begins it knows about how much that is, and refuses
/// more: beyond a limit a wrong unit, or one digit too many, is likelier than a wish. Whoever does
/// wish so sets the environment variable to a larger number, for any program that uses the engine.
struct Limit {
  const char* variable;
  const char* things;  ///< "triangles"
  double most;
};

/// Of a mesh that is made or remeshed. Scans that people edit have up to some millions; remeshing
/// to this many takes some minutes and 10 GB.
inline constexpr Limit kMostTriangles{"LAPWING_MOST_TRIANGLES", "triangles", 20e6};

/// Around the seam of a transplant, where nobody has asked for an edge length: some seconds of
/// remeshing. Seams have some thousand where host and part are of like size; as many as host and
/// part have together are allowed in any case.
inline constexpr Limit kMostSeamTriangles{"LAPWING_MOST_SEAM_TRIANGLES", "triangles", 200e3};

/// Of one picture: 16384 x 16384, the widest that devices commonly draw, and 1 GB.
inline constexpr Limit kMostPixels{"LAPWING_MOST_PIXELS", "pixels", 16384.0 * 16384.0};

/// Of a turntable: an hour at 25 in a second.
inline constexpr Limit kMostFrames{"LAPWING_MOST_FRAMES", "pictures", 100e3};

/// Of triangles whose boxes overlap, which are compared for intersections: some seconds. A surface
/// has about ten for each triangle, and may have kPairsOfTriangle whatever the limit.
inline constexpr Limit kMostPairs{"LAPWING_MOST_PAIRS", "pairs of triangles", 20e6};
inline constexpr double kPairsOfTriangle = 100.0;

/// The number in force. Throws InputError where the variable is set to what is no number above 0.
double most_of(const Limit& limit);

/// Throws InputError when `count` is beyond the limit: "`what` N triangles, more than the M that
/// are allowed; `remedy`, or set LAPWING_... to a larger number". `what` ends in a verb: "the seam
/// would get about".
void require_at_most(const Limit& limit, double count, const std::string& what,
                     const std::string& remedy);

/// Of the memory that is available, what one operation may take: the rest of the program and the
/// file cache need some, too.
inline constexpr double kMemoryShare = 0.75;

/// Overrides that share of what is available, in bytes.
inline constexpr const char* kMemoryVariable = "LAPWING_MOST_MEMORY";

/// What an operation may take of `limit_bytes`; with 0, what LAPWING_MOST_MEMORY says or, where
/// that is not set, kMemoryShare of what is available now; as much as it likes where that is not
/// known.
std::size_t allowed_memory(std::size_t limit_bytes = 0);

/// Throws SolverError when `bytes` are more than `allowed_memory()`: "`what` needs N MB of memory,
/// and may take M MB; `remedy`, ...".
void require_memory(std::size_t bytes, const std::string& what, const std::string& remedy);

/// "12 MB", rounded up.
std::string in_megabytes(std::size_t bytes);

}  // namespace lapwing
