// Limits of CPU time in tests.
#pragma once

namespace hooke {

// How many times as long a computation may take when it is compiled with a sanitizer.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr double sanitizer_slowdown = 30.0;
#else
inline constexpr double sanitizer_slowdown = 1.0;
#endif

}  // namespace hooke
