#include "trainer/page_net_training.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/core/text.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/silhouette/page_net.h"
#include "libskel/silhouette/working_colors.h"
#include "trainer/checkpoint.h"
#include "trainer/conv_net_trainer.h"
#include "trainer/jointed_drawing.h"
#include "trainer/page_loss.h"
#include "trainer/pages/page.h"
#include "trainer/writable_output.h"

namespace skel {
namespace {

// Streams of random numbers of one seed. Pages have a stream each by number.
enum Stream : std::uint64_t { kInitialStream = 1, kPageStream = 1u << 20, kValidationStream = 1ull << 48 };

PageOptions pageOptions(const PageTrainingOptions& options, const std::vector<JointedDrawing>& drawings) {
  PageOptions out;
  out.drawn_share = options.drawn_share;
  out.drawings.resize(drawings.size());
  parallelFor(drawings.size(), options.threads, [&](std::size_t i) {
    const Image image = readImage(drawings[i].image);
    out.drawings[i] = smallDrawing(image, silhouetteOf(image, drawings[i]).mask, {}, FigureView::kFront);
  });
  return out;
}

std::vector<Page> drawPages(const PageTrainingOptions& options, const PageOptions& page_options,
                            std::uint64_t first, int count) {
  std::vector<Page> pages(static_cast<std::size_t>(count));
  parallelFor(pages.size(), options.threads, [&](std::size_t i) {
    Rng rng(options.seed, first + i);
    pages[i] = generatePage(rng, page_options);
  });
  return pages;
}

// Mean loss, mean intersection over union, and the share of pages on which that is at least .9.
struct PageReport {
  double loss = 0, iou = 0, good = 0;
};

PageReport validate(const PageNet& net, const std::vector<Page>& pages, int threads) {
  std::vector<PageReport> reports(pages.size());
  parallelFor(pages.size(), threads, [&](std::size_t i) {
    ConvNetMaps maps(net);
    encodePage(pages[i].rgb, maps.maps[0]);
    forward(net, bestInstructionSet(), maps);
    reports[i].loss = pageLoss(maps.maps.back(), pages[i].figure, 0, nullptr);
    int both = 0, either = 0;
    for (int y = 0; y < pages[i].figure.rows; ++y)
      for (int x = 0; x < pages[i].figure.cols; ++x) {
        const bool is = pages[i].figure.at<std::uint8_t>(y, x) > 127,
                   said = maps.maps.back()[pageLogitIndex(y, x)] > 0;
        both += is && said;
        either += is || said;
      }
    reports[i].iou = either == 0 ? 1 : static_cast<double>(both) / either;
    reports[i].good = reports[i].iou >= .9;
  });
  PageReport mean;
  for (const PageReport& r : reports) {
    const auto n = static_cast<double>(reports.size());
    mean.loss += r.loss / n;
    mean.iou += r.iou / n;
    mean.good += r.good / n;
  }
  return mean;
}

MadeBy madePagesBy(const PageTrainingOptions& options, const std::vector<JointedDrawing>& drawings) {
  MadeBy made_by{{options.steps}, {}};
  made_by.add("skel-train", "pages");
  made_by.add("--start", contentOfFile(options.start));
  made_by.add("--seed", std::to_string(options.seed));
  made_by.add("--batch", options.batch);
  made_by.add("--rate", options.peak_rate);
  made_by.add("--drawings", contentOf(drawings));
  made_by.add("--drawn", options.drawn_share);
  made_by.add("--validation", options.validation_pages);
  return made_by;
}

void writeSheet(const PageTrainingOptions& options, const PageOptions& page_options) {
  constexpr int kColumns = 8, kRows = 5;
  const std::vector<Page> pages = drawPages(options, page_options, kValidationStream, kColumns * kRows);
  cv::Mat sheet(kRows * kPageNetSize, kColumns * kPageNetSize, CV_8UC3, cv::Scalar::all(128));
  for (int i = 0; i < kColumns * kRows; ++i) {
    const Page& page = pages[static_cast<std::size_t>(i)];
    cv::Mat shown = page.rgb.clone(), edge;
    cv::morphologyEx(page.figure > 127, edge, cv::MORPH_GRADIENT, cv::Mat::ones(2, 2, CV_8U));
    shown.setTo(cv::Scalar(255, 0, 200), edge);
    shown.copyTo(
        sheet(cv::Rect(i % kColumns * kPageNetSize, i / kColumns * kPageNetSize, shown.cols, shown.rows)));
  }
  writeFile(options.sheet, encodePng(imageOfRgb(sheet)));
}

}  // namespace

void bindPageTrainingOptions(CLI::App& command, PageTrainingOptions& options) {
  command.add_option("-o,--output", options.output, "Weights file to write")
      ->capture_default_str()
      ->check(outputFile("skel-page-net"));
  command.add_option("--start", options.start, "Net to go on from")->type_name("FILE");
  command.add_option("--checkpoint", options.checkpoint, "File to go on from, and to write at each report")
      ->check(outputFile(kAnyFormat));
  command.add_option("--sheet", options.sheet, "Picture of generated pages to write, instead of training")
      ->type_name("FILE")
      ->check(outputFile());
  command.add_option("--seed", options.seed, "Of all random numbers")
      ->check(seedNumber())
      ->capture_default_str();
  command.add_option("--steps", options.steps)->check(numberIn(1, 10'000'000))->capture_default_str();
  command.add_option("--batch", options.batch, "Pages a step")
      ->check(numberIn(4, 1024))
      ->capture_default_str();
  command.add_option("--rate", options.peak_rate, "Highest learning rate")
      ->check(numberIn(1e-9, 1.))
      ->capture_default_str();
  command
      .add_option("--drawings", options.drawings,
                  "Drawings that some pages show: *.joints.json and *.mask.png, or what skel-label saves")
      ->type_name("DIR")
      ->take_all();
  command.add_option("--drawn", options.drawn_share, "Share of figures that come from them")
      ->check(numberIn(0., 1.))
      ->capture_default_str();
  command.add_option("--threads", options.threads, "0: one a core")
      ->check(numberIn(0, 256))
      ->capture_default_str();
  command.add_option("--validation", options.validation_pages, "Pages that a report measures on")
      ->check(numberIn(1, 1'000'000))
      ->capture_default_str();
  command.add_option("--report-every", options.report_every, "Steps")
      ->check(numberIn(1, 1'000'000))
      ->capture_default_str();
}

ExitCode runPageTraining(const PageTrainingOptions& options) {
  const std::vector<JointedDrawing> drawings = findJointedDrawings(options.drawings);
  const PageOptions page_options = pageOptions(options, drawings);
  if (!options.sheet.empty()) {
    writeSheet(options, page_options);
    return ExitCode::kDone;
  }
  PageNet net = makePageNet();
  if (options.start.empty()) {
    Rng rng(options.seed, kInitialStream);
    initialise(net, rng);
  } else {
    net = parsePageNet(readFile(options.start), options.start);
  }
  ensureWritableFile(options.output);
  ConvNetSchedule schedule;
  schedule.steps = options.steps;
  schedule.batch = options.batch;
  schedule.peak_rate = options.peak_rate;
  schedule.threads = options.threads;
  ConvNetTrainer trainer(net, schedule);
  MadeBy made_by = madePagesBy(options, drawings);
  goOnFrom(options.checkpoint, made_by, trainer);
  const std::vector<Page> validation =
      drawPages(options, page_options, kValidationStream, options.validation_pages);
  std::vector<Page> pages(static_cast<std::size_t>(options.batch));
  ProgressBar bar("training", static_cast<std::size_t>(options.steps));
  bar.advance(static_cast<std::size_t>(trainer.steps()));
  // The net and the checkpoint.
  const auto write = [&] {
    net.parameters = trainer.averaged();
    quantize(net);
    const PageReport r = validate(net, validation, options.threads);
    std::ostringstream provenance;
    provenance << "skel-train pages: seed " << options.seed << ", step " << trainer.steps() << " of "
               << stepsOf(made_by) << ", batch " << options.batch << ", " << page_options.drawings.size()
               << " drawings for " << page_options.drawn_share << " of the figures, validation IoU " << r.iou;
    net.provenance = provenance.str();
    writeFile(options.output, formatPageNet(net));
    keepCheckpoint(options.checkpoint, made_by, trainer);
    return r;
  };
  if (trainer.done()) write();
  double loss = 0;
  int counted = 0;
  while (!trainer.done()) {
    loss += trainer.step({[&](int b, std::vector<float>& input) {
                            Rng page_rng(options.seed,
                                         kPageStream +
                                             static_cast<std::uint64_t>(trainer.steps() * options.batch + b));
                            pages[b] = generatePage(page_rng, page_options);
                            encodePage(pages[b].rgb, input);
                          },
                          [&](int b, const std::vector<float>& output, std::vector<float>& gradient) {
                            return pageLoss(output, pages[b].figure, 1. / options.batch, &gradient);
                          }});
    ++counted;
    bar.advance();
    if (trainer.steps() % options.report_every != 0 && !trainer.done()) continue;
    const PageReport r = write();
    bar.clear();
    std::printf("step %lld  loss %.4f  validation: loss %.4f  IoU %.4f  of at least .9 %.3f\n",
                static_cast<long long>(trainer.steps()), loss / counted, r.loss, r.iou, r.good);
    std::fflush(stdout);
    loss = 0;
    counted = 0;
  }
  bar.clear();
  std::printf("wrote %s (used once it replaces weights/page_net.bin and skel is built anew)\n",
              printable(options.output).c_str());
  return ExitCode::kDone;
}

}  // namespace skel
