// Independent pieces of work on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace skel {

// What a number of threads means: 0 is one a core.
std::size_t threadCount(int threads);

// Calls work(i) once for each i in [0, count) on up to `threads` threads (0: one a core). The pieces must not
// depend on each other, so that results do not depend on the number of threads. The exception of the smallest
// i is thrown again here, after all pieces have ended.
void parallelFor(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

}  // namespace skel
