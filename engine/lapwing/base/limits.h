#pragma once

#include <cstddef>
#include <string>

namespace lapwing {

/// The largest size of an operation, which throws an error before it begins if the limit is
/// exceeded. A wrong unit or an extra digit is then the likely cause. To allow more, set the
/// environment variable to a larger number; this works for every program that uses the engine.
struct Limit {
  const char* variable;
  const char* things;  ///< "triangles"
  double most;
};

/// Triangles of a generated or remeshed mesh. Scans have up to some millions. Remeshing to 20
/// million takes some minutes and 10 GB of memory.
inline constexpr Limit kMostTriangles{"LAPWING_MOST_TRIANGLES", "triangles", 20e6};

/// Triangles around the seam of a transplant without a given edge length: some seconds of
/// remeshing. If host and part have similar sizes, seams have some thousands. The total number of
/// triangles of host and part is always allowed.
inline constexpr Limit kMostSeamTriangles{"LAPWING_MOST_SEAM_TRIANGLES", "triangles", 200e3};

/// Pixels of one image: 16384 x 16384, which is the usual limit of devices and 1 GB of memory.
inline constexpr Limit kMostPixels{"LAPWING_MOST_PIXELS", "pixels", 16384.0 * 16384.0};

/// Images of a turntable: about an hour at 25 images per second.
inline constexpr Limit kMostFrames{"LAPWING_MOST_FRAMES", "pictures", 100e3};

/// Pairs of triangles with overlapping bounding boxes, which are tested for intersections: some
/// seconds. A surface has about ten pairs per triangle; kPairsOfTriangle per triangle are always
/// allowed.
inline constexpr Limit kMostPairs{"LAPWING_MOST_PAIRS", "pairs of triangles", 20e6};
inline constexpr double kPairsOfTriangle = 100.0;

/// Returns the current value of the limit. Throws InputError if the variable is not a positive
/// number.
double limit_value(const Limit& limit);

/// Throws InputError if `count` exceeds the limit: "`what` N triangles, more than the limit of M;
/// `remedy`, or set LAPWING_... to a larger number". `what` is the start of this sentence, such as
/// "the seam would get about".
void require_at_most(const Limit& limit, double count, const std::string& what,
                     const std::string& remedy);

/// Fraction of the available memory that one operation may use. The program and the file cache also
/// need some.
inline constexpr double kMemoryShare = 0.75;

/// Environment variable that replaces this fraction by a number of bytes.
inline constexpr const char* kMemoryVariable = "LAPWING_MOST_MEMORY";

/// Returns the memory limit of an operation: `limit_bytes`, unless it is 0, otherwise
/// LAPWING_MOST_MEMORY, if it is set, otherwise kMemoryShare times the available memory. If the
/// available memory is unknown, there is no limit.
std::size_t allowed_memory(std::size_t limit_bytes = 0);

/// Throws SolverError if `bytes` exceeds `allowed_memory()`: "`what` needs N MB of memory, more
/// than the limit of M MB; `remedy`, ...".
void require_memory(std::size_t bytes, const std::string& what, const std::string& remedy);

/// Returns a text such as "12 MB", rounded up.
std::string in_megabytes(std::size_t bytes);

}  // namespace lapwing
