#pragma once

// LAPWING_ADDRESS_SANITIZER and LAPWING_THREAD_SANITIZER, where tests are compiled with one. GCC
// defines names for them, clang has features.

#if defined(__SANITIZE_ADDRESS__)
#define LAPWING_ADDRESS_SANITIZER
#elif defined(__SANITIZE_THREAD__)
#define LAPWING_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define LAPWING_ADDRESS_SANITIZER
#elif __has_feature(thread_sanitizer)
#define LAPWING_THREAD_SANITIZER
#endif
#endif
