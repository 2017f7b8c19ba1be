#pragma once

#include <type_traits>
#include <variant>

#ifdef __x86_64__
#include <xmmintrin.h>
#endif

namespace lapwing::cholesky {

/// While an object of this class exists, the calling thread treats denormal operands and results as
/// 0. Entries of a factor decay with the distance between their unknowns, and in floats many become
/// denormal. CPUs compute with denormals a hundred times more slowly: they tripled the time to
/// factorize `blade.off`.
class FlushedDenormals {
 public:
#if defined(__x86_64__)
  FlushedDenormals() : state_(_mm_getcsr()) {
    _mm_setcsr(state_ | 0x8040U);
  }
  ~FlushedDenormals() {
    _mm_setcsr(state_);
  }
#elif defined(__aarch64__)
  FlushedDenormals() {
    asm volatile("mrs %0, fpcr" : "=r"(state_));
    asm volatile("msr fpcr, %0" : : "r"(state_ | (1UL << 24)));
  }
  ~FlushedDenormals() {
    asm volatile("msr fpcr, %0" : : "r"(state_));
  }
#else
  FlushedDenormals() = default;
  ~FlushedDenormals() {}
#endif
  FlushedDenormals(const FlushedDenormals&) = delete;
  FlushedDenormals& operator=(const FlushedDenormals&) = delete;

 private:
#if defined(__x86_64__)
  unsigned state_;
#elif defined(__aarch64__)
  unsigned long state_ = 0;
#endif
};

/// FlushedDenormals for floats. Does nothing for doubles, whose range is large enough for these
/// entries.
template <typename Real>
class DenormalsFor {
  std::conditional_t<std::is_same_v<Real, float>, FlushedDenormals, std::monostate> flushed_;
};

}  // namespace lapwing::cholesky
