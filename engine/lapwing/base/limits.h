#pragma once

#include <cstddef>
#include <string>

namespace lapwing {

/// The largest size of one operation, which refuses larger ones before it begins. Beyond a limit, a
/// wrong unit or an extra digit is more likely than intent. To allow more, set the environment
/// variable to a larger number; this works for every program that uses the engine.
struct Limit {
  const char* variable;
  const char* things;  ///< "triangles"
  double most;
};

/// Triangles of a generated or remeshed mesh. Scans in use have up to some millions. Remeshing to
/// this many takes some minutes and 10 GB.
inline constexpr Limit kMostTriangles{"LAPWING_MOST_TRIANGLES", "triangles", 20e6};

/// Triangles around the seam of a transplant without a given edge length: some seconds of
/// remeshing. Seams have some thousands if host and part have similar sizes. As many as host and
/// part have together are always allowed.
inline constexpr Limit kMostSeamTriangles{"LAPWING_MOST_SEAM_TRIANGLES", "triangles", 200e3};

/// Pixels of one picture: 16384 x 16384, the common limit of devices, and 1 GB.
inline constexpr Limit kMostPixels{"LAPWING_MOST_PIXELS", "pixels", 16384.0 * 16384.0};

/// Pictures of a turntable: about an hour at 25 per second.
inline constexpr Limit kMostFrames{"LAPWING_MOST_FRAMES", "pictures", 100e3};

/// Pairs of triangles with overlapping boxes, which are tested for intersections: some seconds. A
/// surface has about ten for each triangle, and kPairsOfTriangle per triangle are always allowed.
inline constexpr Limit kMostPairs{"LAPWING_MOST_PAIRS", "pairs of triangles", 20e6};
inline constexpr double kPairsOfTriangle = 100.0;

/// Returns the limit in force. Throws InputError if the variable is not a number above 0.
double limit_value(const Limit& limit);

/// Throws InputError if `count` exceeds the limit: "`what` N triangles, more than the limit of M;
/// `remedy`, or set LAPWING_... to a larger number". `what` is the sentence up to the number:
/// "the seam would get about".
void require_at_most(const Limit& limit, double count, const std::string& what,
                     const std::string& remedy);

/// Share of the available memory for one operation. The rest of the program and the file cache need
/// some, too.
inline constexpr double kMemoryShare = 0.75;

/// Overrides that share with a number of bytes.
inline constexpr const char* kMemoryVariable = "LAPWING_MOST_MEMORY";

/// Returns the memory limit of an operation: `limit_bytes`, or if that is 0 LAPWING_MOST_MEMORY, or
/// if that is not set kMemoryShare of the memory available now. There is no limit if that is
/// unknown.
std::size_t allowed_memory(std::size_t limit_bytes = 0);

/// Throws SolverError if `bytes` exceed `allowed_memory()`: "`what` needs N MB of memory, more than
/// the limit of M MB; `remedy`, ...".
void require_memory(std::size_t bytes, const std::string& what, const std::string& remedy);

/// Returns a text such as "12 MB", rounded up.
std::string in_megabytes(std::size_t bytes);

}  // namespace lapwing
