#include "trainer/part_net_training.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <sstream>

#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/core/text.h"
#include "libskel/image/write_image.h"
#include "libskel/layers/part_net.h"
#include "libskel/silhouette/working_colors.h"
#include "trainer/checkpoint.h"
#include "trainer/conv_net_trainer.h"
#include "trainer/held_things.h"
#include "trainer/part_loss.h"
#include "trainer/part_samples.h"
#include "trainer/posed_parts.h"
#include "trainer/writable_output.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

// Streams of random numbers of one seed. Samples have a stream each by number.
enum PartStream : std::uint64_t {
  kInitialPartStream = 1,
  kSampleStream = 1u << 20,
  kValidationPartStream = 1ull << 48
};

// Throws InputError where none of them has parts.
std::vector<PartSample> readSamples(const std::vector<JointedDrawing>& drawings, const std::string& shapes,
                                    int threads) {
  if (drawings.empty()) return {};
  const auto files = drawingsWithShapes(drawings, shapes);
  std::vector<std::optional<PartSample>> read(files.size());
  parallelFor(files.size(), threads, [&](std::size_t i) {
    if (const auto whole = readPartSample(files[i].first, files[i].second)) read[i] = smallPartSample(*whole);
  });
  std::vector<PartSample> samples;
  for (auto& sample : read)
    if (sample) samples.push_back(std::move(*sample));
  if (samples.empty())
    throw InputError(shapes, "0 of " + std::to_string(drawings.size()) +
                                 " drawings have parts: nothing to learn from, or to measure by "
                                 "(script/shape-maps writes their shapes)");
  std::printf("%zu of %zu drawings have parts\n", samples.size(), drawings.size());
  std::fflush(stdout);
  return samples;
}

MadeBy madePartsBy(const PartTrainingOptions& options, const std::vector<JointedDrawing>& drawings,
                   const std::vector<JointedDrawing>& held_out) {
  MadeBy made_by{{options.steps}, {}};
  made_by.add("skel-train", "parts");
  made_by.add("--start", contentOfFile(options.start));
  made_by.add("--seed", std::to_string(options.seed));
  made_by.add("--batch", options.batch);
  made_by.add("--rate", options.peak_rate);
  made_by.add("--averaging", options.averaging);
  std::vector<std::string> shapes;
  for (const auto& [option, all] : {std::pair{"--drawings", &drawings}, std::pair{"--held-out", &held_out}}) {
    std::vector<JointedDrawing> with_shapes;
    for (auto& [drawing, file] : drawingsWithShapes(*all, options.shapes)) {
      with_shapes.push_back(std::move(drawing));
      shapes.push_back(std::move(file));
    }
    made_by.add(option, contentOf(with_shapes));
  }
  made_by.add("--shapes", contentOfFiles(shapes));
  made_by.add("--drawn", options.drawn_share);
  made_by.add("--posed", options.posed_share);
  made_by.add("--things", options.thing_share);
  made_by.add("--animals", options.animal_share);
  return made_by;
}

struct Lesson {
  PartSample sample;
  PartSkeleton seen;  // its skeleton as the net is told
  std::array<int, 4> before{};
};

Lesson lesson(Rng& rng, const PartTrainingOptions& options, const std::vector<PartSample>& drawings) {
  Lesson out;
  if (!drawings.empty() && rng.chance(options.drawn_share)) {
    const auto some = [&]() -> const PartSample& {
      return drawings[rng.below(static_cast<std::uint32_t>(drawings.size()))];
    };
    PartSample drawn = some();
    if (rng.chance(options.posed_share)) drawn = posedPartSample(rng, drawn);
    if (rng.chance(options.thing_share)) drawn = withThings(rng, drawn, some());
    out.sample = warpedPartSample(rng, drawn);
  } else {
    out.sample = generatedPartSample(rng, rng.chance(options.animal_share) ? "quadruped" : "biped");
  }
  out.before = limbsBefore(out.sample);
  repaintPartSample(rng, out.sample);
  out.seen = withNoise(rng, out.sample.skeleton, kPartNetSize);
  return out;
}

int partSaid(const std::vector<float>& logits, int y, int x) {
  const float* z = logits.data() + partLogitIndex(y, x, 0);
  return static_cast<int>(std::max_element(z, z + kPartCount) - z);
}

struct PartReport {
  double loss = 0;
  std::array<std::int64_t, kPartCount> both{}, either{};
  double limbs = 0;  // mean IoU of those that are seen, drawing by drawing
  int limb_count = 0, before_right = 0, before_count = 0;
};

PartReport validate(const PartNet& net, const std::vector<Lesson>& lessons, int threads) {
  std::vector<PartReport> reports(lessons.size());
  parallelFor(lessons.size(), threads, [&](std::size_t i) {
    const auto& [sample, seen, before] = lessons[i];
    PartReport& r = reports[i];
    ConvNetMaps maps(net);
    encodeParts(sample.rgb, sample.mask, seen, maps.maps[0]);
    forward(net, bestInstructionSet(), maps);
    const std::vector<float>& logits = maps.maps.back();
    r.loss = partLoss(logits, sample.part, before, 0, nullptr);
    std::array<double, 4> order{};
    std::array<std::int64_t, 4> count{};
    for (int y = 0; y < sample.part.rows; ++y)
      for (int x = 0; x < sample.part.cols; ++x) {
        const int is = sample.part.at<std::uint8_t>(y, x);
        if (is >= kPartCount) continue;
        const int said = partSaid(logits, y, x);
        ++r.either[std::size_t(is)];
        if (said == is)
          ++r.both[std::size_t(is)];
        else
          ++r.either[std::size_t(said)];
        if (const int limb = is - int(Part::kRightArm); limb >= 0 && limb < 4) {
          order[std::size_t(limb)] += logits[partLogitIndex(y, x, kPartCount)];
          ++count[std::size_t(limb)];
        }
      }
    for (std::size_t k = 0; k < 4; ++k) {
      constexpr int kSeen = 60;  // px
      if (count[k] < kSeen) continue;
      const std::size_t part = std::size_t(limbPart(int(k)));
      r.limbs += double(r.both[part]) / double(r.either[part]);
      ++r.limb_count;
      if (before[k] < 0) continue;
      ++r.before_count;
      r.before_right += (order[k] > 0) == (before[k] == 1);
    }
  });
  PartReport all;
  for (const PartReport& r : reports) {
    all.loss += r.loss / double(reports.size());
    for (std::size_t k = 0; k < kPartCount; ++k) all.both[k] += r.both[k], all.either[k] += r.either[k];
    all.limbs += r.limbs, all.limb_count += r.limb_count;
    all.before_right += r.before_right, all.before_count += r.before_count;
  }
  all.limbs /= std::max(1, all.limb_count);
  return all;
}

// "-": there is nothing that it is the mean of.
template <class Count>
std::string shownOf(Count count, double mean, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, mean);
  return count > 0 ? text : "-";
}

cv::Vec3b partColour(int part) {
  constexpr std::array<std::array<int, 3>, kPartCount> kColours = {{{150, 150, 150},
                                                                    {230, 230, 120},
                                                                    {120, 70, 30},
                                                                    {230, 60, 60},
                                                                    {50, 110, 230},
                                                                    {240, 160, 30},
                                                                    {40, 170, 80},
                                                                    {220, 120, 220},
                                                                    {90, 220, 220},
                                                                    {60, 60, 60}}};
  if (part >= kPartCount) return {255, 255, 255};
  const auto& c = kColours[std::size_t(part)];
  return cv::Vec3b(std::uint8_t(c[0]), std::uint8_t(c[1]), std::uint8_t(c[2]));
}

void writeSheet(const PartTrainingOptions& options, const std::vector<PartSample>& drawings) {
  constexpr int kColumns = 6, kRows = 6;
  const bool said = !options.start.empty();
  const PartNet net = said ? parsePartNet(readFile(options.start), options.start) : PartNet();
  const int cell = kPartNetSize * (said ? 3 : 2);
  cv::Mat sheet(kRows * kPartNetSize, kColumns * cell, CV_8UC3, cv::Scalar::all(255));
  for (int i = 0; i < kColumns * kRows; ++i) {
    Rng rng(options.seed, kSampleStream + static_cast<std::uint64_t>(i));
    const auto& [sample, seen, before] = lesson(rng, options, drawings);
    const auto put = [&](const cv::Mat& picture, int column) {
      picture.copyTo(sheet(cv::Rect(i % kColumns * cell + column * kPartNetSize, i / kColumns * kPartNetSize,
                                    picture.cols, picture.rows)));
    };
    put(sample.rgb, 0);
    cv::Mat parts(sample.part.size(), CV_8UC3);
    for (int y = 0; y < parts.rows; ++y)
      for (int x = 0; x < parts.cols; ++x)
        parts.at<cv::Vec3b>(y, x) = partColour(sample.part.at<std::uint8_t>(y, x));
    for (int k = 0; k < 4; ++k)
      for (const Eigen::Vector2d& p : seen.limbs[std::size_t(k)])
        cv::circle(parts, cv::Point(cvRound(p.x()), cvRound(p.y())), 2,
                   before[std::size_t(k)] == 1 ? cv::Scalar(0, 0, 0) : cv::Scalar::all(255), -1);
    put(parts, 1);
    if (!said) continue;
    ConvNetMaps maps(net);
    encodeParts(sample.rgb, sample.mask, seen, maps.maps[0]);
    forward(net, bestInstructionSet(), maps);
    for (int y = 0; y < parts.rows; ++y)
      for (int x = 0; x < parts.cols; ++x)
        parts.at<cv::Vec3b>(y, x) = sample.mask.at<std::uint8_t>(y, x) == 0
                                        ? cv::Vec3b(255, 255, 255)
                                        : partColour(partSaid(maps.maps.back(), y, x));
    put(parts, 2);
  }
  writeFile(options.sheet, encodePng(imageOfRgb(sheet)));
}

// What a ruler of parts measures against: of each drawing a folder with image.png, mask.png, parts.png (grey:
// 0 outside, 1 + Part) and order.json (which part lies before which; which of these borders no line shows).
void writeTruth(const PartTrainingOptions& options) {
  constexpr double kMostly = .75, kDrawn = .5;
  constexpr int kLeastBorder = 30, kContrast = 30;
  const auto files = drawingsWithShapes(findJointedDrawings(options.held_out), options.shapes);
  if (files.empty()) throw UsageError("--truth: no drawing of --held-out has shapes in --shapes");
  parallelFor(files.size(), options.threads, [&](std::size_t i) {
    const JointedDrawing& drawing = files[i].first;
    const auto sample = readPartSample(drawing, files[i].second);
    if (!sample || !drawing.mask) return;
    cv::Mat gradient, channels[3];
    cv::morphologyEx(sample->rgb, gradient, cv::MORPH_GRADIENT, cv::Mat::ones(7, 7, CV_8U));
    cv::split(gradient, channels);
    const cv::Mat edge = cv::max(channels[0], cv::max(channels[1], channels[2]));
    struct Border {
      int over = 0, all = 0, drawn = 0;
    };
    std::array<std::array<Border, kPartCount>, kPartCount> borders{};
    Image parts(sample->part.cols, sample->part.rows);
    for (int y = 0; y < parts.height; ++y)
      for (int x = 0; x < parts.width; ++x) {
        const int a = sample->part.at<std::uint8_t>(y, x);
        const bool inside = sample->mask.at<std::uint8_t>(y, x) != 0 && a < kPartCount;
        std::fill_n(parts.pixel(x, y), 3, static_cast<std::uint8_t>(inside ? a + 1 : 0));
        parts.pixel(x, y)[3] = 255;
        for (const cv::Point& step : {cv::Point(1, 0), cv::Point(0, 1), cv::Point(-1, 0), cv::Point(0, -1)}) {
          const cv::Point q = cv::Point(x, y) + step;
          if (!inside || q.x < 0 || q.y < 0 || q.x >= parts.width || q.y >= parts.height) continue;
          const int b = sample->part.at<std::uint8_t>(q);
          if (b == a || b >= kPartCount || sample->mask.at<std::uint8_t>(q) == 0) continue;
          Border& border = borders[std::size_t(a)][std::size_t(b)];
          ++border.all;
          border.over += sample->order.at<std::uint16_t>(y, x) > sample->order.at<std::uint16_t>(q);
          border.drawn += edge.at<std::uint8_t>(y, x) > kContrast;
        }
      }
    std::string before, unseen;
    for (int a = 0; a < kPartCount; ++a)
      for (int b = 0; b < kPartCount; ++b) {
        const Border& border = borders[std::size_t(a)][std::size_t(b)];
        if (border.all < kLeastBorder || border.over < kMostly * border.all) continue;
        const std::string pair = "[" + std::to_string(a + 1) + ", " + std::to_string(b + 1) + "]";
        before += (before.empty() ? "" : ", ") + pair;
        if (border.drawn < kDrawn * border.all) unseen += (unseen.empty() ? "" : ", ") + pair;
      }
    const fs::path folder = fs::path(options.truth) / fs::path(drawing.image).stem();
    writeFile((folder / "image.png").string(), readFile(drawing.image));
    writeFile((folder / "mask.png").string(), readFile(*drawing.mask));
    writeFile((folder / "parts.png").string(), encodePng(parts));
    writeFile((folder / "order.json").string(),
              "{\"before\": [" + before + "], \"by_eye\": [" + unseen + "]}\n");
  });
}

}  // namespace

void bindPartTrainingOptions(CLI::App& command, PartTrainingOptions& options) {
  command.add_option("-o,--output", options.output, "Weights file to write")
      ->check(outputFile("skel-part-net"));
  command.add_option("--start", options.start, "Net to go on from")->type_name("FILE");
  command.add_option("--checkpoint", options.checkpoint, "File to go on from, and to write at each report")
      ->check(outputFile(kAnyFormat));
  command
      .add_option("--sheet", options.sheet,
                  "Picture of samples to write, instead of training; with --start what that net says of them")
      ->type_name("FILE")
      ->check(outputFile());
  command
      .add_option("--truth", options.truth,
                  "Folder to write the parts of --held-out to, for rulers, instead of training")
      ->type_name("DIR")
      ->check(outputFile());
  command.add_option("--seed", options.seed, "Of all random numbers")
      ->check(seedNumber())
      ->capture_default_str();
  command.add_option("--steps", options.steps)->check(numberIn(1, 10'000'000))->capture_default_str();
  command.add_option("--batch", options.batch, "Figures a step")
      ->check(numberIn(4, 1024))
      ->capture_default_str();
  command.add_option("--rate", options.peak_rate, "Highest learning rate")
      ->check(numberIn(1e-9, 1.))
      ->capture_default_str();
  command.add_option("--averaging", options.averaging, "Of the weights over steps")
      ->check(numberIn(0., .999999))
      ->capture_default_str();
  command.add_option("--shapes", options.shapes, "What script/shape-maps has written")->type_name("DIR");
  command.add_option("--drawings", options.drawings, "Drawings to learn from: *.joints.json with --shapes")
      ->type_name("DIR")
      ->take_all();
  command.add_option("--held-out", options.held_out, "Drawings that only measure")
      ->type_name("DIR")
      ->take_all();
  command.add_option("--drawn", options.drawn_share, "Share of figures that come from --drawings")
      ->check(numberIn(0., 1.))
      ->capture_default_str();
  command.add_option("--posed", options.posed_share, "Share of these whose limbs are turned")
      ->check(numberIn(0., 1.))
      ->capture_default_str();
  command
      .add_option("--things", options.thing_share, "Share of these that are given things to hold or carry")
      ->check(numberIn(0., 1.))
      ->capture_default_str();
  command.add_option("--animals", options.animal_share, "Share of generated figures that go on four feet")
      ->check(numberIn(0., 1.))
      ->capture_default_str();
  command.add_option("--threads", options.threads, "0: one a core")
      ->check(numberIn(0, 256))
      ->capture_default_str();
  command.add_option("--report-every", options.report_every, "Steps")
      ->check(numberIn(1, 1'000'000))
      ->capture_default_str();
}

ExitCode runPartTraining(const PartTrainingOptions& options) {
  if (!options.truth.empty()) {
    writeTruth(options);
    return ExitCode::kDone;
  }
  const std::vector<JointedDrawing> named = findJointedDrawings(options.drawings);
  const std::vector<PartSample> drawings = readSamples(named, options.shapes, options.threads);
  if (!options.sheet.empty()) {
    writeSheet(options, drawings);
    return ExitCode::kDone;
  }
  if (options.output.empty()) throw UsageError("-o is missing: the weights file to write");
  std::vector<Lesson> validation;
  const std::vector<JointedDrawing> held_out = findJointedDrawings(options.held_out);
  for (const PartSample& sample : readSamples(held_out, options.shapes, options.threads)) {
    Rng rng(options.seed, kValidationPartStream + validation.size());
    Lesson& l = validation.emplace_back();
    l.sample = fittedPartSample(sample);
    l.before = limbsBefore(l.sample);
    l.seen = withNoise(rng, l.sample.skeleton, kPartNetSize);
  }
  PartNet net = makePartNet();
  if (options.start.empty()) {
    Rng rng(options.seed, kInitialPartStream);
    initialise(net, rng);
  } else {
    net = parsePartNet(readFile(options.start), options.start);
  }
  ensureWritableFile(options.output);
  ConvNetSchedule schedule;
  schedule.steps = options.steps;
  schedule.batch = options.batch;
  schedule.peak_rate = options.peak_rate;
  schedule.averaging = options.averaging;
  schedule.threads = options.threads;
  ConvNetTrainer trainer(net, schedule);
  MadeBy made_by = madePartsBy(options, named, held_out);
  goOnFrom(options.checkpoint, made_by, trainer);
  std::vector<Lesson> lessons(static_cast<std::size_t>(options.batch));
  ProgressBar bar("training", static_cast<std::size_t>(options.steps));
  bar.advance(static_cast<std::size_t>(trainer.steps()));
  // The net and the checkpoint.
  const auto write = [&] {
    net.parameters = trainer.averaged();
    quantize(net);
    const PartReport r = validate(net, validation, options.threads);
    std::ostringstream provenance;
    provenance << "skel-train parts: seed " << options.seed << ", step " << trainer.steps() << " of "
               << stepsOf(made_by) << ", batch " << options.batch << ", " << drawings.size()
               << " drawings for " << options.drawn_share << " of the figures, IoU of limbs on "
               << validation.size() << " others " << r.limbs;
    net.provenance = provenance.str();
    writeFile(options.output, formatPartNet(net));
    keepCheckpoint(options.checkpoint, made_by, trainer);
    return r;
  };
  if (trainer.done()) write();
  double loss = 0;
  int counted = 0;
  while (!trainer.done()) {
    loss += trainer.step({[&](int b, std::vector<float>& input) {
                            Rng rng(options.seed, kSampleStream + static_cast<std::uint64_t>(
                                                                      trainer.steps() * options.batch + b));
                            Lesson& l = lessons[std::size_t(b)];
                            l = lesson(rng, options, drawings);
                            encodeParts(l.sample.rgb, l.sample.mask, l.seen, input);
                          },
                          [&](int b, const std::vector<float>& output, std::vector<float>& gradient) {
                            const Lesson& l = lessons[std::size_t(b)];
                            return partLoss(output, l.sample.part, l.before, 1. / options.batch, &gradient);
                          }});
    ++counted;
    bar.advance();
    if (trainer.steps() % options.report_every != 0 && !trainer.done()) continue;
    const PartReport r = write();
    bar.clear();
    std::printf(
        "step %lld  loss %.4f  validation: loss %s  limbs %s  before %s of %d  parts",
        static_cast<long long>(trainer.steps()), loss / counted,
        shownOf(validation.size(), r.loss, "%.4f").c_str(), shownOf(r.limb_count, r.limbs, "%.4f").c_str(),
        shownOf(r.before_count, double(r.before_right) / r.before_count, "%.3f").c_str(), r.before_count);
    for (std::size_t k = 0; k < kPartCount; ++k)
      std::printf(" %s", shownOf(r.either[k], double(r.both[k]) / double(r.either[k]), "%.3f").c_str());
    std::printf("\n");
    std::fflush(stdout);
    loss = 0;
    counted = 0;
  }
  bar.clear();
  std::printf("wrote %s\n", printable(options.output).c_str());
  return ExitCode::kDone;
}

}  // namespace skel
