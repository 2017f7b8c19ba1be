// The inner loops of Lbfgs (elastic/lbfgs_history.cpp). Included by history_loops_*.cpp inside an
// unnamed namespace. Calls no function with external linkage, for which the linker could use the
// copy of another instruction set.

typedef double Lanes __attribute__((vector_size(sizeof(double) * kLanes)));
typedef float RoughLanes __attribute__((vector_size(sizeof(float) * kLanes)));

#define LAPWING_INLINE static inline __attribute__((always_inline))

// Number of partial sums. It is the same for every instruction set, so that all add in the same
// order.
constexpr std::size_t kSums = 16;
constexpr std::size_t kParts = kSums / kLanes;

// memcpy allows unaligned addresses with every compiler; it compiles to a single load or store.
LAPWING_INLINE Lanes lanes_at(const double* p) {
  Lanes lanes;
  __builtin_memcpy(&lanes, p, sizeof lanes);
  return lanes;
}
LAPWING_INLINE Lanes lanes_at(const float* p) {
  RoughLanes lanes;
  __builtin_memcpy(&lanes, p, sizeof lanes);
  return __builtin_convertvector(lanes, Lanes);
}
LAPWING_INLINE void put_at(double* p, Lanes lanes) { __builtin_memcpy(p, &lanes, sizeof lanes); }

LAPWING_INLINE double sum_of(const double* v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

template <typename Number>
LAPWING_INLINE double sum_of_products(const float* a, const Number* b, std::size_t count) {
  Lanes sums[kParts] = {};
  std::size_t k = 0;
  for (; k + kSums <= count; k += kSums) {
    for (std::size_t part = 0; part < kParts; ++part) {
      const std::size_t at = k + part * kLanes;
      sums[part] += lanes_at(a + at) * lanes_at(b + at);
    }
  }
  double all[kSums / 2];
  for (std::size_t part = 0; part < kParts / 2; ++part) {
    put_at(all + part * kLanes, sums[part] + sums[part + kParts / 2]);
  }
  double sum = sum_of(all);
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
  for (; k + kLanes <= count; k += kLanes) {
    put_at(x + k, lanes_at(x + k) - factor * lanes_at(difference + k));
  }
  for (; k < count; ++k) x[k] -= factor * difference[k];
}
