// Eigen's matrices and what is C take their memory from these. The linker calls them in place of
// the library's, which it calls __real_NAME (ld, --wrap).
#include <cstddef>

#include "support/failing_new.h"

using lapwing::test::allocation_fails;

extern "C" {

void* __real_malloc(std::size_t bytes);
void* __real_calloc(std::size_t count, std::size_t bytes);
void* __real_realloc(void* memory, std::size_t bytes);

void* __wrap_malloc(std::size_t bytes) {
  return allocation_fails() ? nullptr : __real_malloc(bytes);
}
void* __wrap_calloc(std::size_t count, std::size_t bytes) {
  return allocation_fails() ? nullptr : __real_calloc(count, bytes);
}
void* __wrap_realloc(void* memory, std::size_t bytes) {
  return allocation_fails() ? nullptr : __real_realloc(memory, bytes);
}

}  // extern "C"
