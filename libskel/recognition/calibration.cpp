#include "libskel/recognition/calibration.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skel {

double areaUnderRoc(const std::vector<Forecast>& forecasts) {
  std::vector<Forecast> sorted = forecasts;
  std::sort(sorted.begin(), sorted.end(),
            [](const Forecast& a, const Forecast& b) { return a.probability < b.probability; });
  double pairs = 0, before = 0, came_true = 0;  // before: that did not come true, of lower probability
  for (std::size_t i = 0; i < sorted.size();) {
    double yes = 0, no = 0;
    const double probability = sorted[i].probability;
    for (; i < sorted.size() && sorted[i].probability == probability; ++i) ++(sorted[i].came_true ? yes : no);
    pairs += yes * (before + no / 2);
    before += no;
    came_true += yes;
  }
  return before == 0 || came_true == 0 ? .5 : pairs / (before * came_true);
}

double calibrationError(const std::vector<Forecast>& forecasts) {
  constexpr int kBins = 10;
  std::array<double, kBins> off{};  // sum of what was said less what came out
  for (const Forecast& f : forecasts)
    off[static_cast<std::size_t>(std::clamp(static_cast<int>(f.probability * kBins), 0, kBins - 1))] +=
        f.probability - f.came_true;
  double sum = 0;
  for (const double o : off) sum += std::abs(o);
  return forecasts.empty() ? 0 : sum / static_cast<double>(forecasts.size());
}

}  // namespace skel
