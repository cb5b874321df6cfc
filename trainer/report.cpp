#include "trainer/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "libskel/core/files.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/write_image.h"

namespace skel {
namespace {

constexpr double kText = 9;  // height of capitals, px

std::string number(double value, const char* format = "%.3g") {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Both curves over the epochs, the loss on a logarithmic scale.
Image lossPicture(const Training& training) {
  constexpr double kMargin = 70, kTop = 40, kWidth = 540, kHeight = 300;
  Image image = blankImage(640, 390);
  float low = 1, high = 1e-6f;
  for (const auto* curve : {&training.training_curve, &training.validation_curve})
    for (const float loss : *curve) {
      low = std::min(low, std::max(loss, 1e-6f));
      high = std::max(high, loss);
    }
  const double bottom = std::log10(low), range = std::max(std::log10(high) - bottom, 1e-3);
  const auto count = static_cast<double>(std::max<std::size_t>(training.training_curve.size(), 2));
  const auto place = [&](double epoch, double loss) {
    return Eigen::Vector2d(kMargin + kWidth * epoch / (count - 1),
                           kTop + kHeight * (1 - (std::log10(std::max(loss, 1e-6)) - bottom) / range));
  };
  for (int tick = 0; tick <= 4; ++tick) {
    const double y = kTop + kHeight * tick / 4;
    drawLine(image, {kMargin, y}, {kMargin + kWidth, y}, 1, kGrey.withAlpha(90));
    drawText(image, {8, y + kText / 2}, number(std::pow(10, bottom + range * (4 - tick) / 4)), kText);
    const double x = kMargin + kWidth * tick / 4;
    drawText(image, {x - 8, kTop + kHeight + 24}, std::to_string(std::lround((count - 1) * tick / 4)), kText);
  }
  drawText(image, {kMargin, kTop + kHeight + 42}, "epoch", kText, kGrey);
  const auto draw = [&](const std::vector<float>& curve, Color color, const char* name, double x) {
    if (curve.empty()) return;
    Points points;
    for (std::size_t i = 0; i < curve.size(); ++i) points.push_back(place(static_cast<double>(i), curve[i]));
    drawPolyline(image, points, 2, color);
    drawText(image, {x, 22}, name, kText, color);
  };
  draw(training.training_curve, kLeft, "mean squared error, training", kMargin);
  draw(training.validation_curve, kRight, "held-out characters", kMargin + 300);
  const auto kept = static_cast<double>(training.epochs);
  drawLine(image, {place(kept, 1).x(), kTop}, {place(kept, 1).x(), kTop + kHeight}, 1, kInk);
  return image;
}

// A row for each true class: its share found as each class, and the count.
Image confusionPicture(const Evaluation& evaluation) {
  constexpr double kCell = 84, kMargin = 90, kTop = 60;
  Image image = blankImage(440, 410);
  drawText(image, {kMargin, 22}, "found as (column), is (row)", kText, kGrey);
  for (int row = 0; row < kJointClassCount; ++row) {
    const auto& cells = evaluation.confusion[static_cast<std::size_t>(row)];
    int sum = 0;
    for (const int cell : cells) sum += cell;
    const char* name = kJointClassNames[static_cast<std::size_t>(row)];
    drawText(image, {14, kTop + kCell * (row + 0.5)}, name, kText, classColor(name));
    drawText(image, {kMargin + kCell * row + 20, kTop - 12}, name, kText, classColor(name));
    for (int column = 0; column < kJointClassCount; ++column) {
      const int cell = cells[static_cast<std::size_t>(column)];
      const double share = sum > 0 ? static_cast<double>(cell) / sum : 0;
      const double x = kMargin + kCell * column, y = kTop + kCell * row;
      const Points square = {{x, y}, {x + kCell - 3, y}, {x + kCell - 3, y + kCell - 3}, {x, y + kCell - 3}};
      fillPolygons(image, {square}, kLeft.withAlpha(static_cast<std::uint8_t>(12 + 243 * share)));
      const Color ink = share > 0.55 ? kWhite : kInk;
      drawText(image, {x + 14, y + 36}, number(share, "%.2f"), kText + 2, ink);
      drawText(image, {x + 14, y + 60}, std::to_string(cell), kText - 2, ink);
    }
  }
  return image;
}

}  // namespace

void writeReport(const std::string& dir, const Training& training, const Evaluation& evaluation) {
  ensureWritableFolder(dir);
  nlohmann::ordered_json json;
  json["epochs"] = training.epochs;
  json["loss"] = training.loss;
  json["training_curve"] = training.training_curve;
  json["validation_curve"] = training.validation_curve;
  json["evaluation"] = nlohmann::ordered_json::parse(formatEvaluation(evaluation));
  writeFile(dir + "/report.json", json.dump(2) + "\n");
  writeFile(dir + "/loss.png", encodePng(lossPicture(training)));
  writeFile(dir + "/confusion.png", encodePng(confusionPicture(evaluation)));
}

}  // namespace skel
