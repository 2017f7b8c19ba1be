// Lets the same source compile for float64 (if LAPWING_FLOAT64 is defined) and float32.

#ifdef LAPWING_FLOAT64
#define real double
#define real3 dvec3
#define real4 dvec4
#define real3x3 dmat3
#define real4x4 dmat4
// Must equal kCollinearShare in laplacian/ring_fit.h.
const real kCollinearShare = 1e-12LF;
// The next two constants must equal those in laplacian/rotation.cpp.
const real kRankOneShare = 1e-12LF;
const real kSmallestGap = 1e-6LF;
// Newton's method for the largest root ends with a step of at most this length.
const real kConverged = 1e-14LF;
// Must equal the constant in kernels/rotate_frames.cpp.
const real kRoundingShare = 1e-12LF;
#else
#define real float
#define real3 vec3
#define real4 vec4
#define real3x3 mat3
#define real4x4 mat4
// For a collinear ring, rounding errors make the determinant about 1e-7 instead of 0.
const real kCollinearShare = 1e-6;
const real kRankOneShare = 1e-6;
const real kSmallestGap = 1e-2;
const real kConverged = 1e-6;
const real kRoundingShare = 1e-6;
#endif
