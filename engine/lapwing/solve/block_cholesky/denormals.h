#pragma once

#include <type_traits>
#include <variant>

#ifdef __x86_64__
#include <xmmintrin.h>
#endif

namespace lapwing::cholesky {

/// While one lives, denormal numbers are 0 on the calling thread, as operands and as results. The
/// entries of a factor decay away from a coupling, and floats, whose range is short, soon hold them
/// as denormals. Processors take a hundred times as long for those: the factorization of
/// `blade.off` took three times as long with them.
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

/// FlushedDenormals for floats, and nothing for doubles, in which entries do not decay that far.
template <typename Real>
class DenormalsFor {
  std::conditional_t<std::is_same_v<Real, float>, FlushedDenormals, std::monostate> flushed_;
};

}  // namespace lapwing::cholesky
