// How near the colours of figures on photographed pages come to those that were drawn, circumstance by
// circumstance:
//
//   bench-texture [--dump DIR] [--every N] [--as-is] DIR...
//
// Pages are those of bench-silhouette, one drawing of N, the figure's mask is given. Prints the mean
// difference of colours within it (OKLab, 100 from black to white) before and after the light and the ruling
// of the page are taken off (libskel/silhouette/even_light.h), and on how many pages; --dump writes each
// page, and page, before, after and what was drawn side by side. --as-is takes the drawings as they lie
// there, finds their figures, and lists those whose colours change and by how much.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "bench/drawn_pages.h"
#include "libskel/core/files.h"
#include "libskel/draw/oklab.h"
#include "libskel/image/write_image.h"
#include "libskel/silhouette/even_light.h"
#include "libskel/silhouette/working_colors.h"

namespace skel {
namespace {

Color colorOf(const std::uint8_t* p) { return {p[0], p[1], p[2], 255}; }

// Mean over the figure, of 100.
double difference(const Image& image, const HardPage& page, std::size_t figure) {
  double sum = 0, count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (!page.figures[figure].at<std::uint8_t>(y, x)) continue;
      const Eigen::Vector3f apart =
          oklabFromSrgb(colorOf(image.pixel(x, y))) - oklabFromSrgb(colorOf(page.drawn.ptr(y) + 3 * x));
      sum += 100 * static_cast<double>(apart.norm()), ++count;
    }
  return sum / std::max(1., count);
}

Plane8 planeOf(const cv::Mat& mask) { return Eigen::Map<const Plane8>(mask.data, mask.rows, mask.cols); }

void dump(const HardPage& page, const Image& even, const std::string& path) {
  cv::Mat cut(page.rgb.size(), CV_8UC3, cv::Scalar(150, 200, 150)), after = cut.clone(), drawn = cut.clone();
  cv::Mat clean(page.rgb.size(), CV_8UC3);
  cv::mixChannels(rgbaOf(even), clean, {0, 0, 1, 1, 2, 2});
  page.rgb.copyTo(cut, page.figures[0]);
  clean.copyTo(after, page.figures[0]);
  page.drawn.copyTo(drawn, page.figures[0]);
  cv::Mat shown;
  cv::hconcat(std::vector<cv::Mat>{page.rgb, cut, after, drawn}, shown);
  writeFile(std::filesystem::path(path).replace_extension(".page.png").string(),
            encodePng(imageOfRgb(page.rgb)));
  const double scale = std::min(1., 1800. / shown.cols);
  cv::resize(shown, shown, {}, scale, scale, cv::INTER_AREA);
  writeFile(path, encodePng(imageOfRgb(shown)));
}

double msSince(std::clock_t start) {
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

int runAsIs(const std::vector<std::string>& folders, int every, const std::string& dump_folder) {
  int count = 0, changed = 0;
  double all_ms = 0, own_ms = 0;
  for (const AnnotatedImage& drawing : drawingsWithMask(folders, every)) {
    const Image image = readImage(drawing.image);
    std::clock_t start = std::clock();
    const Silhouette silhouette = extractSilhouette(image);
    all_ms += msSince(start);
    if (!silhouette.found()) continue;
    ++count;
    start = std::clock();
    const Image even = evenLight(image, silhouette);
    own_ms += msSince(start);
    if (even.empty()) continue;
    ++changed;
    HardPage page;
    page.rgb.create(image.height, image.width, CV_8UC3);
    page.drawn = page.rgb.clone();
    cv::mixChannels(rgbaOf(image), page.rgb, {0, 0, 1, 1, 2, 2});
    cv::mixChannels(rgbaOf(even), page.drawn, {0, 0, 1, 1, 2, 2});
    page.figures = {
        cv::Mat(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(silhouette.mask.data()))};
    std::printf("%5.2f  %s%s\n", difference(image, page, 0), drawing.image.c_str(),
                silhouette.ruling && !silhouette.ruling->empty() ? " (ruled)" : "");
    if (dump_folder.empty()) continue;
    const std::filesystem::path path(drawing.image);
    const bool folder = path.stem() == "image";
    dump(page, even,
         dump_folder + "/" + (folder ? path.parent_path().filename() : path.stem()).string() + ".png");
  }
  std::printf("%d of %d change; %.1f ms beside %.1f ms for the silhouette\n", changed, count,
              own_ms / std::max(1, count), all_ms / std::max(1, count));
  return 0;
}

int run(const std::vector<std::string>& folders, int every, const std::string& dump_folder) {
  const std::vector<AnnotatedImage> drawings = drawingsWithMask(folders, every);
  const std::vector<Circumstance> all = circumstances();
  struct Page {
    double before = 0, after = 0, time_ms = 0;
    bool changed = false;
  };
  std::vector<std::vector<Page>> pages(all.size(), std::vector<Page>(drawings.size()));
  forEachPage(drawings, all, [&](std::size_t c, std::size_t i, const HardPage& page) {
    const Image image = imageOfRgb(page.rgb);
    const Silhouette silhouette = silhouetteFromMask(planeOf(page.figures[0]));
    if (!silhouette.found()) return;
    const std::clock_t start = std::clock();
    Image even = evenLight(image, silhouette);
    Page& result = pages[c][i];
    result.time_ms = msSince(start);
    result.changed = !even.empty();
    result.before = result.after = difference(image, page, 0);
    if (even.empty()) even = image;
    if (result.changed) result.after = difference(even, page, 0);
    if (!dump_folder.empty())
      dump(page, even,
           dump_folder + "/" + all[c].name + "-" + std::to_string(int(result.before)) + "-" +
               std::to_string(int(result.after)) + "-" +
               std::filesystem::path(drawings[i].image).stem().string() + ".png");
  });
  for (std::size_t c = 0; c < all.size(); ++c) {
    double before = 0, after = 0, changed = 0, worse = 0, time_ms = 0;
    const double n = static_cast<double>(drawings.size());
    for (const Page& page : pages[c])
      before += page.before / n, after += page.after / n, changed += page.changed / n,
          worse += (page.after > page.before + 0.5) / n, time_ms += page.time_ms / n;
    std::printf("%-8s  %5.2f -> %5.2f  changed %.2f  worse %.2f  %.1f ms\n", all[c].name, before, after,
                changed, worse, time_ms);
  }
  std::printf("(%zu drawings)\n", drawings.size());
  return 0;
}

}  // namespace
}  // namespace skel

int main(int argc, char** argv) {
  std::vector<std::string> folders;
  std::string dump;
  int every = 1;
  bool as_is = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--every" && i + 1 < argc)
      every = std::max(1, std::atoi(argv[++i]));
    else if (argument == "--as-is")
      as_is = true;
    else if (argument == "--dump" && i + 1 < argc)
      dump = argv[++i];
    else
      folders.push_back(argument);
  }
  return as_is ? skel::runAsIs(folders, every, dump) : skel::run(folders, every, dump);
}
