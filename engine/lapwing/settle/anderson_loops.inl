// The inner loops of Anderson (settle/anderson.cpp). Included by anderson_loops_*.cpp inside an
// unnamed namespace. Calls nothing that has external linkage: the linker would be free to take
// another instruction set's copy.

constexpr std::size_t kLanes = 8;
typedef double Lanes __attribute__((vector_size(sizeof(double) * kLanes), may_alias, aligned(8)));
typedef float RoughLanes __attribute__((vector_size(sizeof(float) * kLanes), may_alias,
                                        aligned(4)));

#define LAPWING_INLINE static inline __attribute__((always_inline))

LAPWING_INLINE Lanes& lanes_at(double* p) { return *reinterpret_cast<Lanes*>(p); }
LAPWING_INLINE Lanes lanes_at(const double* p) { return *reinterpret_cast<const Lanes*>(p); }
LAPWING_INLINE Lanes lanes_at(const float* p) {
  return __builtin_convertvector(*reinterpret_cast<const RoughLanes*>(p), Lanes);
}

LAPWING_INLINE double sum_of(Lanes v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

void multiply(const float* difference, const float* newest, const double* residual,
              std::size_t count, double& with_newest, double& with_residual) {
  Lanes newest_sum[2] = {};
  Lanes residual_sum[2] = {};
  std::size_t k = 0;
  for (; k + 2 * kLanes <= count; k += 2 * kLanes) {
    for (std::size_t part = 0; part < 2; ++part) {
      const std::size_t at = k + part * kLanes;
      const Lanes d = lanes_at(difference + at);
      newest_sum[part] += d * lanes_at(newest + at);
      residual_sum[part] += d * lanes_at(residual + at);
    }
  }
  with_newest = sum_of(newest_sum[0] + newest_sum[1]);
  with_residual = sum_of(residual_sum[0] + residual_sum[1]);
  for (; k < count; ++k) {
    const double d = difference[k];
    with_newest += d * newest[k];
    with_residual += d * residual[k];
  }
}

void subtract(double factor, const float* difference, double* x, std::size_t count) {
  std::size_t k = 0;
  for (; k + kLanes <= count; k += kLanes) lanes_at(x + k) -= factor * lanes_at(difference + k);
  for (; k < count; ++k) x[k] -= factor * difference[k];
}
