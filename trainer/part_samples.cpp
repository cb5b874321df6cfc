#include "trainer/part_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "libskel/core/error.h"
#include "libskel/image/read_image.h"
#include "trainer/figures/figure.h"
#include "trainer/figures/repaint.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;
namespace fs = std::filesystem;

// By the names of a plan's joints.
PartSkeleton partSkeleton(bool animal, const std::function<Vec(const std::string&)>& joint) {
  PartSkeleton out;
  out.animal = animal;
  out.head = joint("head"), out.body = joint("body");
  if (animal) out.tail_root = joint("tail_root"), out.tail = joint("tail");
  const char* names[2][3] = {{"shoulder", "elbow", animal ? "front_foot" : "hand"},
                             {"hip", "knee", animal ? "hind_foot" : "foot"}};
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i)
      out.limbs[std::size_t(k)][std::size_t(i)] =
          joint(std::string(k % 2 == 0 ? "right_" : "left_") + names[k / 2][i]);
  return out;
}

Part partOf(PartOwner owner) {
  switch (owner) {
    case PartOwner::kHead:
      return Part::kHead;
    case PartOwner::kTorso:
      return Part::kTrunk;
    case PartOwner::kLeftArm:
      return Part::kLeftArm;
    case PartOwner::kRightArm:
      return Part::kRightArm;
    case PartOwner::kLeftLeg:
      return Part::kLeftLeg;
    case PartOwner::kRightLeg:
      return Part::kRightLeg;
    case PartOwner::kTail:
    case PartOwner::kAppendix:
      return Part::kAppendix;
    case PartOwner::kHair:
      return Part::kHair;
    case PartOwner::kSkirt:
      return Part::kSkirt;
    case PartOwner::kNone:
      break;
  }
  return Part::kThing;
}

void swapSides(PartSkeleton& skeleton) {
  std::swap(skeleton.limbs[0], skeleton.limbs[1]);
  std::swap(skeleton.limbs[2], skeleton.limbs[3]);
}

void swapSides(cv::Mat& part) {
  for (auto p = part.begin<std::uint8_t>(); p != part.end<std::uint8_t>(); ++p)
    if (*p >= int(Part::kRightArm) && *p <= int(Part::kLeftLeg))
      *p = static_cast<std::uint8_t>(((*p - int(Part::kRightArm)) ^ 1) + int(Part::kRightArm));
}

// Crop to the figure.
PartSample cropped(const PartSample& sample) {
  const cv::Rect box = cv::boundingRect(sample.mask);
  PartSample out = sample;
  out.rgb = sample.rgb(box).clone(), out.mask = sample.mask(box).clone();
  out.part = sample.part(box).clone(), out.order = sample.order(box).clone();
  out.skeleton = moved(sample.skeleton, [&](const Vec& p) { return Vec(p - Vec(box.x, box.y)); });
  return out;
}

// By an affine map of the plane, then shifted and scaled so that its box's long side is `size`.
PartSample transformed(const PartSample& sample, const Eigen::Matrix2d& linear, int size) {
  std::vector<cv::Point> inside;
  cv::findNonZero(sample.mask, inside);
  Vec low = Vec::Constant(1e9), high = Vec::Constant(-1e9);
  for (const cv::Point& p : inside)
    for (const double dx : {0., 1.})
      for (const double dy : {0., 1.}) {
        const Vec q = linear * Vec(p.x + dx, p.y + dy);
        low = low.cwiseMin(q), high = high.cwiseMax(q);
      }
  const double scale = size / (high - low).maxCoeff();
  const cv::Size fit(std::clamp(int(std::lround((high - low).x() * scale)), 1, size),
                     std::clamp(int(std::lround((high - low).y() * scale)), 1, size));
  const Eigen::Matrix2d a = scale * linear;
  const Vec shift = -scale * low;
  // OpenCV's pixels have their centres at whole numbers.
  const Vec b = a * Vec(.5, .5) + shift - Vec(.5, .5);
  const cv::Matx23d map(a(0, 0), a(0, 1), b.x(), a(1, 0), a(1, 1), b.y());
  PartSample out;
  out.side_view = sample.side_view;
  cv::warpAffine(sample.rgb, out.rgb, map, fit, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::warpAffine(sample.mask, out.mask, map, fit, cv::INTER_NEAREST);
  cv::warpAffine(sample.part, out.part, map, fit, cv::INTER_NEAREST, cv::BORDER_CONSTANT,
                 cv::Scalar(kNoPart));
  cv::warpAffine(sample.order, out.order, map, fit, cv::INTER_NEAREST);
  out.skeleton = moved(sample.skeleton, [&](const Vec& p) { return Vec(a * p + shift); });
  return out;
}

// DIR/characters/<name>.shapes.png or, of datasets/unseen/characters/<name>.png, DIR/unseen/characters/…
std::string shapesOf(const std::string& image, const std::string& folder) {
  const fs::path path = fs::path(image).lexically_normal(), parent = path.parent_path();
  const std::string name = path.stem().string() + ".shapes.png";
  const fs::path near = fs::path(folder) / parent.filename() / name,
                 far = fs::path(folder) / parent.parent_path().filename() / parent.filename() / name;
  return fs::exists(far) ? far.string() : fs::exists(near) ? near.string() : "";
}

}  // namespace

PartSkeleton moved(const PartSkeleton& skeleton, const std::function<Vec(const Vec&)>& move) {
  PartSkeleton out = skeleton;
  out.head = move(out.head), out.body = move(out.body);
  out.tail_root = move(out.tail_root), out.tail = move(out.tail);
  for (auto& limb : out.limbs)
    for (Vec& p : limb) p = move(p);
  return out;
}

std::array<int, 4> limbsBefore(const PartSample& sample) {
  constexpr int kLeastBorder = 8;
  constexpr double kMostly = .75;
  std::array<int, 4> over{}, under{};
  const auto see = [&](const cv::Point& p, const cv::Point& q) {
    const int mine = sample.part.at<std::uint8_t>(p), other = sample.part.at<std::uint8_t>(q);
    const int limb = mine - int(Part::kRightArm);
    if (limb < 0 || limb > 3 || other == mine || other == kNoPart) return;
    const int a = sample.order.at<std::uint16_t>(p), b = sample.order.at<std::uint16_t>(q);
    (a > b ? over : under)[std::size_t(limb)] += a != b;
  };
  for (int y = 0; y < sample.part.rows; ++y)
    for (int x = 0; x < sample.part.cols; ++x)
      for (const cv::Point& step : {cv::Point(1, 0), cv::Point(0, 1)}) {
        const cv::Point p(x, y), q = p + step;
        if (q.x >= sample.part.cols || q.y >= sample.part.rows) continue;
        see(p, q), see(q, p);
      }
  std::array<int, 4> before{};
  for (std::size_t k = 0; k < 4; ++k) {
    const int all = over[k] + under[k];
    before[k] = all < kLeastBorder ? -1 : over[k] >= kMostly * all ? 1 : under[k] >= kMostly * all ? 0 : -1;
  }
  return before;
}

std::vector<std::pair<JointedDrawing, std::string>> drawingsWithShapes(
    const std::vector<JointedDrawing>& drawings, const std::string& shapes) {
  std::vector<std::pair<JointedDrawing, std::string>> files;
  if (drawings.empty()) return files;
  if (shapes.empty()) throw UsageError("--shapes is missing: the folder that script/shape-maps has written");
  if (!fs::is_directory(shapes)) throw InputError(shapes, "is no folder; script/shape-maps makes it");
  for (const JointedDrawing& drawing : drawings)
    if (const std::string file = shapesOf(drawing.image, shapes); !file.empty())
      files.emplace_back(drawing, file);
  return files;
}

std::optional<PartSample> readPartSample(const JointedDrawing& drawing, const std::string& shapes_file) {
  const Image image = readImage(drawing.image), shapes = readImage(shapes_file);
  const Plane8 mask = silhouetteOf(image, drawing).mask;
  cv::Mat map(shapes.height, shapes.width, CV_8UC3), colours(image.height, image.width, CV_8UC3);
  for (int y = 0; y < map.rows; ++y)
    for (int x = 0; x < map.cols; ++x)
      for (int c = 0; c < 3; ++c) map.at<cv::Vec3b>(y, x)[c] = shapes.pixel(x, y)[c];
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      for (int c = 0; c < 3; ++c)
        colours.at<cv::Vec3b>(y, x)[c] = static_cast<std::uint8_t>((p[c] * p[3] + 255 * (255 - p[3])) / 255);
    }
  const auto find = [&](const std::string& name) -> const Vec* {
    for (const auto& [joint, at] : drawing.joints)
      if (joint == name && at) return &*at;
    return nullptr;
  };
  bool placed = true;  // all joints
  const auto joint = [&](const std::string& name) -> Vec {
    const Vec* p = find(name);
    placed = placed && p != nullptr;
    return p != nullptr ? *p + Vec(.5, .5) : Vec(Vec::Zero());
  };
  PartSample sample;
  sample.side_view = drawing.side_view;
  sample.rgb = colours;
  sample.mask = cv::Mat(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(mask.data())).clone();
  sample.skeleton = partSkeleton(find("tail") != nullptr, joint);
  if (!placed) return std::nullopt;
  const double scale = double(map.cols) / image.width;
  const std::optional<PartTruth> truth =
      partTruth(map, moved(sample.skeleton, [&](const Vec& p) { return Vec(scale * p); }));
  if (!truth) return std::nullopt;
  cv::resize(truth->part, sample.part, sample.mask.size(), 0, 0, cv::INTER_NEAREST);
  cv::resize(truth->order, sample.order, sample.mask.size(), 0, 0, cv::INTER_NEAREST);
  return sample;
}

PartSample withMargin(const PartSample& sample, int margin) {
  PartSample out = sample;
  const auto pad = [&](const cv::Mat& from, cv::Mat& to, const cv::Scalar& value) {
    cv::copyMakeBorder(from, to, margin, margin, margin, margin, cv::BORDER_CONSTANT, value);
  };
  pad(sample.rgb, out.rgb, cv::Scalar::all(255));
  pad(sample.mask, out.mask, cv::Scalar(0));
  pad(sample.part, out.part, cv::Scalar(kNoPart));
  pad(sample.order, out.order, cv::Scalar(0));
  out.skeleton = moved(sample.skeleton, [&](const Vec& p) { return Vec(p + Vec(margin, margin)); });
  return out;
}

PartSample smallPartSample(const PartSample& whole) {
  PartSample sample = cropped(whole);
  const cv::Size size = sample.mask.size();
  const double smaller = std::min(1., double(kPartSourceSize) / std::max(size.width, size.height));
  const cv::Size fit(std::max(1, cvRound(size.width * smaller)), std::max(1, cvRound(size.height * smaller)));
  cv::resize(sample.rgb, sample.rgb, fit, 0, 0, cv::INTER_AREA);
  for (cv::Mat* plane : {&sample.mask, &sample.part, &sample.order})
    cv::resize(*plane, *plane, fit, 0, 0, cv::INTER_NEAREST);
  sample.skeleton = moved(sample.skeleton, [&](const Vec& p) {
    return Vec(p.x() * fit.width / size.width, p.y() * fit.height / size.height);
  });
  return sample;
}

PartSample generatedPartSample(Rng& rng, const std::string& body_plan) {
  const FigurePlan& plan = figurePlan(body_plan);
  const bool animal = plan.body_plan != "biped";
  constexpr int kOversampling = 2;
  const std::vector<std::string> names = jointNames(plan);
  while (true) {
    Drawing drawing = plan.draw(rng, sampleKind(rng, plan));
    if (!drawing.whole) continue;
    Eigen::Matrix2d linear;
    const double angle = rng.normal(0, rng.chance(.9) ? .08 : .4), c = std::cos(angle), s = std::sin(angle);
    linear << c, -s, s, c;
    linear.col(0) *= std::exp(rng.normal(0, .1));
    linear.col(1) += rng.normal(0, .05) * linear.col(0);
    drawing.scene.transform([&](const Vec& p) { return Vec(linear * p); });
    for (Vec& p : drawing.joints) p = linear * p;
    const Scene::Box box = drawing.scene.box();
    const Vec size = box.high - box.low;
    const double scale = kPartNetSize / size.maxCoeff();
    const int width = std::clamp(int(std::ceil(size.x() * scale)), 1, kPartNetSize),
              height = std::clamp(int(std::ceil(size.y() * scale)), 1, kPartNetSize);
    const auto raster = [&](const Scene& scene) {
      return rasterize(scene, box.low, scale * kOversampling, width * kOversampling, height * kOversampling);
    };
    const Raster seen = raster(drawing.scene), parts = raster(drawing.scene.withoutDetails());
    PartSample sample;
    sample.side_view = drawing.view == FigureView::kSide;
    sample.rgb = cv::Mat(height, width, CV_8UC3, cv::Scalar::all(255));
    sample.mask = cv::Mat(height, width, CV_8U, cv::Scalar(0));
    sample.part = cv::Mat(height, width, CV_8U, cv::Scalar(kNoPart));
    sample.order = cv::Mat(height, width, CV_16U, cv::Scalar(0));
    const auto at = [&](const std::string& name) -> Vec {
      for (std::size_t j = 0; j < names.size(); ++j)
        if (names[j] == name) return (drawing.joints[j] - box.low) * scale;
      throw UsageError("the figures of " + body_plan + " have no " + name);
    };
    sample.skeleton = partSkeleton(animal, at);
    const Vec pelvis = sample.skeleton.pelvis(), up = (sample.skeleton.neck() - pelvis).normalized();
    int solid = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        std::array<int, 3> sum{};
        int inside = 0, u = 0, v = 0;
        for (int b = 0; b < kOversampling; ++b)
          for (int a = 0; a < kOversampling; ++a) {
            const int px = kOversampling * x + a, py = kOversampling * y + b;
            if (!seen.solid(px, py)) continue;
            const Colour colour = seen.colour(px, py);
            for (std::size_t k = 0; k < 3; ++k) sum[k] += colour[k];
            ++inside, u = px, v = py;
          }
        if (inside < 2) continue;
        ++solid;
        for (std::size_t k = 0; k < 3; ++k)
          sample.rgb.at<cv::Vec3b>(y, x)[int(k)] = static_cast<std::uint8_t>(sum[k] / inside);
        sample.mask.at<std::uint8_t>(y, x) = 255;
        if (!parts.solid(u, v)) continue;
        Part part = partOf(parts.owner(u, v));
        // A dress begins at the shoulders.
        if (part == Part::kSkirt && (Vec(x, y) - pelvis).dot(up) > .01 * kPartNetSize) part = Part::kTrunk;
        sample.part.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(part);
        sample.order.at<std::uint16_t>(y, x) =
            parts.part[std::size_t(v) * std::size_t(parts.width) + std::size_t(u)];
      }
    // Figures that are nothing but outlines would be filled by the silhouette stage.
    constexpr double kFilled = .6;
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(sample.mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    double enclosed = 0;
    for (const auto& outline : outlines) enclosed += cv::contourArea(outline);
    if (solid < kFilled * enclosed) continue;
    // As the generator of the joint net has it: which side is the far one cannot be seen from the side.
    if (sample.side_view)
      for (const int k : {0, 2}) {
        const auto& limbs = sample.skeleton.limbs;
        const auto x = [&](int limb) {
          const auto& l = limbs[std::size_t(limb)];
          return l[0].x() + l[1].x() + l[2].x();
        };
        if (x(k) <= x(k + 1)) continue;
        std::swap(sample.skeleton.limbs[std::size_t(k)], sample.skeleton.limbs[std::size_t(k + 1)]);
        const int first = int(Part::kRightArm) + k;
        for (auto p = sample.part.begin<std::uint8_t>(); p != sample.part.end<std::uint8_t>(); ++p)
          if (*p == first || *p == first + 1) *p = static_cast<std::uint8_t>(2 * first + 1 - *p);
      }
    return sample;
  }
}

PartSample warpedPartSample(Rng& rng, const PartSample& sample) {
  const double angle = rng.normal(0, rng.chance(.9) ? .1 : .4), c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix2d linear;
  linear << c, -s, s, c;
  linear.col(0) *= std::exp(rng.normal(0, .12));
  linear.col(1) += rng.normal(0, .07) * linear.col(0);
  const bool mirror = rng.chance(.5);
  if (mirror) linear = Eigen::Vector2d(-1, 1).asDiagonal() * linear;
  PartSample out = transformed(sample, linear, kPartNetSize);
  if (mirror) {
    swapSides(out.skeleton);
    swapSides(out.part);
  }
  return out;
}

PartSample fittedPartSample(const PartSample& sample) {
  return transformed(sample, Eigen::Matrix2d::Identity(), kPartNetSize);
}

void repaintPartSample(Rng& rng, PartSample& sample) {
  const int rows = sample.mask.rows, columns = sample.mask.cols;
  Plane8 mask(rows, columns);
  GridColours colours(rows * columns, 3);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      mask(y, x) = sample.mask.at<std::uint8_t>(y, x);
      for (int k = 0; k < 3; ++k) colours(y * columns + x, k) = sample.rgb.at<cv::Vec3b>(y, x)[k];
    }
  repaint(rng, mask, colours);
  if (rng.chance(.5)) {  // other light
    const auto contrast = static_cast<float>(rng.uniform(.5, 1.3)),
               light = static_cast<float>(rng.normal(0, 25));
    colours = (colours - 160) * contrast + 160 + light;
  }
  if (rng.chance(.1)) colours.rowwise() = Eigen::RowVector3f::Constant(float(rng.uniform(20, 240))).array();
  if (rng.chance(.35)) {
    const auto grain = static_cast<float>(rng.uniform(2, 14));
    for (float& value : colours.reshaped()) value += grain * static_cast<float>(rng.normal());
  }
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      for (int k = 0; k < 3; ++k)
        sample.rgb.at<cv::Vec3b>(y, x)[k] = cv::saturate_cast<std::uint8_t>(colours(y * columns + x, k));
  // A mask that took a px too many or too few.
  const double edge = rng.uniform();
  if (edge < .15) {
    const cv::Mat before = sample.mask.clone();
    cv::dilate(before, sample.mask, cv::Mat::ones(3, 3, CV_8U));
    sample.rgb.setTo(cv::Scalar::all(rng.uniform(200, 255)), sample.mask & ~before);
  } else if (edge < .3) {
    cv::erode(sample.mask, sample.mask, cv::Mat::ones(3, 3, CV_8U));
    sample.part.setTo(kNoPart, sample.mask == 0);
  }
}

PartSkeleton withNoise(Rng& rng, const PartSkeleton& skeleton, double long_side) {
  const auto random = [&](double size) { return Vec(rng.normal(0, size), rng.normal(0, size)); };
  const double size = long_side * (rng.chance(.15) ? .03 : rng.chance(.3) ? .002 : .012);
  PartSkeleton out = moved(skeleton, [&](const Vec& p) { return Vec(p + random(size)); });
  for (auto& limb : out.limbs)
    for (std::size_t i = 1; i < limb.size(); ++i)
      if (rng.chance(.03)) limb[i] += random(.06 * long_side);
  return out;
}

}  // namespace skel
