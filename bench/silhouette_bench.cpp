// How well figures are told from what they are drawn on, circumstance by circumstance:
//
//   bench-silhouette [--net FILE] [--dump DIR] DIR...
//
// Each annotated drawing (*.joints.json and *.mask.png) below the folders is laid flat on white and on a
// colour and composed into pages with what makes it hard (trainer/pages/hard_pages.h). Prints mean IoU and
// the share of at least .9; --dump writes pages with what was found (green) and missed (red).
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "bench/drawn_pages.h"
#include "libskel/core/files.h"
#include "libskel/image/write_image.h"
#include "libskel/silhouette/page_net.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/silhouette/working_colors.h"

namespace skel {
namespace {

void dump(const HardPage& page, const cv::Mat& found, const std::string& path) {
  cv::Mat shown = page.rgb.clone(), truth = cv::Mat::zeros(found.size(), CV_8U);
  for (const cv::Mat& figure : page.figures) truth |= figure;
  shown.setTo(cv::Scalar(0, 200, 0), found & ~truth);
  shown.setTo(cv::Scalar(255, 0, 0), truth & ~found);
  cv::Mat edge;
  cv::morphologyEx(found, edge, cv::MORPH_GRADIENT, cv::Mat::ones(3, 3, CV_8U));
  shown.setTo(cv::Scalar(255, 0, 220), edge);
  const double scale = std::min(1., 400. / std::max(shown.cols, shown.rows));
  cv::resize(shown, shown, {}, scale, scale, cv::INTER_AREA);
  writeFile(path, encodePng(imageOfRgb(shown)));
}

int run(const std::vector<std::string>& folders, const std::string& net_file,
        const std::string& dump_folder) {
  SilhouetteOptions options;
  if (!net_file.empty())
    options.page_net =
        std::make_shared<const PageNet>(readyToRun(parsePageNet(readFile(net_file), net_file)));
  const std::vector<AnnotatedImage> drawings = drawingsWithMask(folders);
  const std::vector<Circumstance> all = circumstances();
  std::vector<std::vector<double>> ious(all.size(), std::vector<double>(drawings.size()));
  forEachPage(drawings, all, [&](std::size_t c, std::size_t i, const HardPage& page) {
    const Silhouette silhouette = extractSilhouette(imageOfRgb(page.rgb), options);
    cv::Mat found = cv::Mat::zeros(page.rgb.size(), CV_8U);
    if (silhouette.found())
      cv::Mat(found.rows, found.cols, CV_8U, const_cast<std::uint8_t*>(silhouette.mask.data())).copyTo(found);
    double& iou = ious[c][i];
    if (silhouette.found()) iou = overlapOnPage(page, silhouette.mask);
    if (!dump_folder.empty()) {
      const std::string name = std::filesystem::path(drawings[i].image).stem().string();
      dump(page, found,
           dump_folder + "/" + all[c].name + "-" + std::to_string(int(100 * iou)) + "-" + name + ".png");
    }
  });
  double sum = 0, sum_good = 0;
  for (std::size_t c = 0; c < all.size(); ++c) {
    double mean = 0, good = 0;
    for (const double iou : ious[c])
      mean += iou / double(drawings.size()), good += (iou >= .9) / double(drawings.size());
    std::printf("%-8s  IoU %.3f  >= .9 %.2f\n", all[c].name, mean, good);
    sum += mean / double(all.size());
    sum_good += good / double(all.size());
  }
  std::printf("%-8s  IoU %.3f  >= .9 %.2f  (%zu drawings)\n", "all", sum, sum_good, drawings.size());
  return 0;
}

}  // namespace
}  // namespace skel

int main(int argc, char** argv) {
  std::vector<std::string> folders;
  std::string net, dump;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--net" && i + 1 < argc)
      net = argv[++i];
    else if (argument == "--dump" && i + 1 < argc)
      dump = argv[++i];
    else
      folders.push_back(argument);
  }
  return skel::run(folders, net, dump);
}
