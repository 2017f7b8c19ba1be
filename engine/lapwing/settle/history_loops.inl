// The inner loops of Lbfgs (settle/lbfgs.cpp). Included by history_loops_*.cpp inside an
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

template <typename Number>
LAPWING_INLINE double sum_of_products(const float* a, const Number* b, std::size_t count) {
  Lanes sums[2] = {};
  std::size_t k = 0;
  for (; k + 2 * kLanes <= count; k += 2 * kLanes) {
    for (std::size_t part = 0; part < 2; ++part) {
      const std::size_t at = k + part * kLanes;
      sums[part] += lanes_at(a + at) * lanes_at(b + at);
    }
  }
  double sum = sum_of(sums[0] + sums[1]);
  for (; k < count; ++k) sum += static_cast<double>(a[k]) * static_cast<double>(b[k]);
  return sum;
}

double multiply(const float* difference, const double* x, std::size_t count) {
  return sum_of_products(difference, x, count);
}

double dot(const float* a, const float* b, std::size_t count) {
  return sum_of_products(a, b, count);
}

void subtract(double factor, const float* difference, double* x, std::size_t count) {
  std::size_t k = 0;
  for (; k + kLanes <= count; k += kLanes) lanes_at(x + k) -= factor * lanes_at(difference + k);
  for (; k < count; ++k) x[k] -= factor * difference[k];
}
