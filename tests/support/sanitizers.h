#pragma once

// Defines LAPWING_ADDRESS_SANITIZER or LAPWING_THREAD_SANITIZER if tests are compiled with that
// sanitizer.

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
