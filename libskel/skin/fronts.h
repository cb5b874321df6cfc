// The fronts of many ways that spread at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace skel {

// A queue that gives the nearest first but for differences below `step`.
class Fronts {
 public:
  struct Front {
    float distance;
    int place, bone;
  };
  explicit Fronts(float step) : step_(step) {}
  void push(const Front& front) {
    const std::size_t bucket = std::max(current_, static_cast<std::size_t>(front.distance / step_));
    if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
    buckets_[bucket].push_back(front);
  }
  bool pop(Front& front) {
    while (current_ < buckets_.size() && next_ == buckets_[current_].size()) {
      buckets_[current_++].clear();
      next_ = 0;
    }
    if (current_ == buckets_.size()) return false;
    front = buckets_[current_][next_++];
    return true;
  }

 private:
  float step_;
  std::vector<std::vector<Front>> buckets_;
  std::size_t current_ = 0, next_ = 0;
};

}  // namespace skel
