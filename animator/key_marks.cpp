#include "animator/key_marks.h"

namespace skel {

std::vector<KeyMark> keyMarks(const std::vector<double>& times_s, double apart_s) {
  std::vector<KeyMark> marks;
  for (const double time_s : times_s)
    if (!marks.empty() && time_s - marks.back().to_s < apart_s)
      marks.back().to_s = time_s;
    else
      marks.push_back({time_s, time_s});
  return marks;
}

}  // namespace skel
