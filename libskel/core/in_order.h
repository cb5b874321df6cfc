// Pieces of work that come one after another, however many: done on several threads, handed on in the order
// in which they came.
#pragma once

#include <cstddef>
#include <functional>

namespace skel {

// What is done to a piece. A piece lies in a slot of the caller's from next() to take(); slots are numbered
// from 0 on, fewer than slotsInOrder(), and used again, so that memory does not grow with the number of
// pieces.
struct StepsInOrder {
  std::function<bool(std::size_t slot)> next;  // puts the next piece there; false: there is none
  std::function<void(std::size_t slot)> work;
  std::function<void(std::size_t slot)> take;
};

// For that many threads (0: one a core).
std::size_t slotsInOrder(int threads);

// next() and take() are called for one piece after the other, though from different threads, and may overlap
// with each other; work() for up to `threads` pieces at a time. A piece is taken as soon as it is done and
// all before it are taken: that the next is waited for holds nobody up. After an exception of any step
// nothing more is begun or taken; it is thrown again when what is at work has ended.
void parallelInOrder(int threads, const StepsInOrder& steps);

}  // namespace skel
