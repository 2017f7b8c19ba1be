// One source in two precisions, selected by LAPWING_FLOAT64.

#ifdef LAPWING_FLOAT64
#define real double
#define real3 dvec3
#define real4 dvec4
#define real3x3 dmat3
#define real4x4 dmat4
// As kCollinearShare of laplacian/ring_fit.h.
const real kCollinearShare = 1e-12LF;
// The next three constants must equal those in laplacian/rotation.cpp and kernels/ring_loops.inl.
const real kRankOneShare = 1e-12LF;
const real kSmallestGap = 1e-6LF;
const real kConverged = 1e-14LF;
// Must equal the constant in kernels/rotate_frames.cpp.
const real kRoundingShare = 1e-12LF;
#else
#define real float
#define real3 vec3
#define real4 vec4
#define real3x3 mat3
#define real4x4 mat4
// Rounding leaves about 1e-7 of the determinant of a collinear ring.
const real kCollinearShare = 1e-6;
const real kRankOneShare = 1e-6;
const real kSmallestGap = 1e-2;
const real kConverged = 1e-6;
const real kRoundingShare = 1e-6;
#endif
