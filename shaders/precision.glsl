// One source in two precisions: LAPWING_FLOAT64 chooses.

#ifdef LAPWING_FLOAT64
#define real double
#define real3 dvec3
#define real3x3 dmat3
// As kCollinearShare of laplacian/ring_fit.h.
const real kCollinearShare = 1e-12LF;
#else
#define real float
#define real3 vec3
#define real3x3 mat3
// Rounding leaves about 1e-7 of the determinant of a collinear ring.
const real kCollinearShare = 1e-6;
#endif
