#pragma once

#include <cstddef>
#include <malloc.h>

#include "support/sanitizers.h"

#ifdef LAPWING_ADDRESS_SANITIZER
// GCC has no header for this function.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();
#endif

namespace lapwing::test {

/// Returns the bytes that the program has allocated and not freed.
inline std::size_t memory_in_use() {
#ifdef LAPWING_ADDRESS_SANITIZER
  return __sanitizer_get_current_allocated_bytes();
#else
  const auto info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
#endif
}

}  // namespace lapwing::test
