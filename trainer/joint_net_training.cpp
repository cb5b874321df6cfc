#include "trainer/joint_net_training.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numbers>
#include <sstream>

#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/check.h"
#include "libskel/core/files.h"
#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/core/sha256.h"
#include "libskel/core/text.h"
#include "libskel/labels/twins.h"
#include "trainer/checkpoint.h"
#include "trainer/conv_net_trainer.h"
#include "trainer/figures/figure.h"
#include "trainer/grown_net.h"
#include "trainer/joint_accuracy.h"
#include "trainer/joint_loss.h"
#include "trainer/jointed_drawing.h"
#include "trainer/posable_drawing.h"
#include "trainer/writable_output.h"

namespace skel {
namespace {

constexpr int kPoses = 2;  // of each drawing in a round, besides its own: posed, with limbs of another

// What the options leave open.
struct Schedule {
  int steps;
  double peak_rate, averaging, drawn_share, left_out;
};
constexpr Schedule kFromNothing = {12000, 2e-3, .999, .4, 0};
// Little by little, so that nothing is forgotten; what is rehearsed is not forgotten anyway.
constexpr Schedule kGoingOn = {900, 3e-4, .99, .5, .2};
constexpr Schedule kRehearsing = {900, 8e-4, .99, .7, .2};

Schedule scheduleOf(const JointTrainingOptions& o) {
  const Schedule& preset = o.start.empty() ? kFromNothing : o.rehearsed.empty() ? kGoingOn : kRehearsing;
  return {o.steps.value_or(preset.steps), o.peak_rate.value_or(preset.peak_rate),
          o.averaging.value_or(preset.averaging), o.drawn_share.value_or(preset.drawn_share),
          o.left_out.value_or(preset.left_out)};
}

// Streams of random numbers of one seed. Figures and batches have a stream each by number.
enum Stream : std::uint64_t {
  kInitialStream = 1,
  kValidationStream = 2,
  kFigureStream = 1u << 20,
  kStepStream = 1ull << 40,
  kPoseStream = 1ull << 48
};

// The kinds that are held back, or all others.
std::vector<int> kindsOf(const FigurePlan& plan, const std::vector<int>& held_back, bool held) {
  std::vector<int> kinds;
  for (int k = 0; k < static_cast<int>(plan.kinds.size()); ++k)
    if ((std::find(held_back.begin(), held_back.end(), k) != held_back.end()) == held) kinds.push_back(k);
  return kinds;
}

struct Sample {
  FramePlacement placement;
  FigureLook look;  // as the net gets to see it
};

// Other ink, other light, other colours: what is drawn counts, not in which colour.
FigureLook recoloured(Rng& rng, const FigureLook& look, double no_colours_share) {
  FigureLook out;
  const double strength = rng.uniform(.4, 1.4);
  out.lines = (look.lines.cast<double>() * strength).min(255).cast<std::uint8_t>();
  const bool grey = rng.chance(.3), flat = rng.chance(no_colours_share);
  const double brightness = flat ? 0 : rng.uniform(.4, 1.4) * (rng.chance(.15) ? -1 : 1);
  const double chroma = grey || flat ? 0 : rng.uniform(.2, 1.5), hue = rng.uniform(0, 2 * std::numbers::pi);
  Eigen::Matrix3d mix = Eigen::Matrix3d::Zero();
  mix(0, 0) = brightness;
  mix.bottomRightCorner<2, 2>() = chroma * Eigen::Rotation2Dd(hue).toRotationMatrix();
  for (Plane8& tone : out.tones) tone.resize(look.lines.rows(), look.lines.cols());
  for (int i = 0; i < look.lines.size(); ++i) {
    Eigen::Vector3d t;
    for (int k = 0; k < 3; ++k) t[k] = look.tones[k].data()[i] - kMeanTone;
    t = mix * t;
    for (int k = 0; k < 3; ++k) {
      out.tones[k].data()[i] = static_cast<std::uint8_t>(std::clamp(std::lround(kMeanTone + t[k]), 0l, 255l));
    }
  }
  return out;
}

Sample augmented(Rng& rng, const Figure& figure, const JointTrainingOptions& options) {
  Sample sample;
  sample.placement = FramePlacement::centred(figure.mask, rng.chance(.5));
  sample.placement.offset_x += static_cast<int>(rng.below(7)) - 3;
  sample.placement.offset_y += static_cast<int>(rng.below(7)) - 3;
  if (!rng.chance(options.no_look_share))
    sample.look = recoloured(rng, figure.look, options.no_colours_share);
  return sample;
}

// Mean loss and the share of joints whose highest cell is within 10 % and 5 % of the figure's long side.
struct Report {
  double loss = 0, within_10 = 0, within_5 = 0, whole_right = 0;
};

Report validate(const JointNet& net, const NetJoints& joints, InstructionSet set,
                const std::vector<Figure>& figures, int threads) {
  const int count = joints.count(), channels = heatmapChannels(count);
  std::vector<Report> reports(figures.size());
  parallelFor(figures.size(), threads, [&](std::size_t i) {
    thread_local ConvNetMaps maps(net);
    const Figure& figure = figures[i];
    const FramePlacement placement = FramePlacement::centred(figure.mask);
    encodeJointNetInput(figure.mask, figure.look, placement, net.maps[0].channels, maps.maps[0]);
    forward(net, set, maps);
    const std::vector<float>& heatmaps = maps.maps.back();
    const JointTarget target = jointTarget(figure, placement, joints);
    Report& report = reports[i];
    report.loss = jointLoss<float>(heatmaps, target, 0, nullptr);
    double logit = 0;
    std::vector<int> best(count, 0);
    const auto at = [&](int cell, int c) {
      return heatmaps[static_cast<std::size_t>(
                          paddedIndex(kHeatmapSize, cell / kHeatmapSize, cell % kHeatmapSize)) *
                          channels +
                      c];
    };
    for (int cell = 0; cell < kHeatmapSize * kHeatmapSize; ++cell) {
      logit += at(cell, net.figureChannel());
      for (int j = 0; j < count; ++j) {
        if (at(cell, j) > at(best[j], j)) best[j] = cell;
      }
    }
    report.whole_right = (logit > 0) == figure.whole;
    for (int j = 0; j < count; ++j) {
      const Eigen::Vector2d cell(best[j] % kHeatmapSize, best[j] / kHeatmapSize);
      const double error =
          4 * (cell - target.joints[j].cell).norm() / std::max(figure.mask.rows(), figure.mask.cols());
      report.within_10 += error <= .1;
      report.within_5 += error <= .05;
    }
  });
  Report mean;
  int whole = 0;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    mean.whole_right += reports[i].whole_right / static_cast<double>(figures.size());
    if (!figures[i].whole) continue;
    ++whole;
    mean.loss += reports[i].loss;
    mean.within_10 += reports[i].within_10 / count;
    mean.within_5 += reports[i].within_5 / count;
  }
  for (double* v : {&mean.loss, &mean.within_10, &mean.within_5}) *v /= std::max(1, whole);
  return mean;
}

std::vector<Figure> drawFigures(std::uint64_t seed, std::uint64_t first, int count,
                                const FigureOptions& options, int threads) {
  std::vector<Figure> figures(count);
  parallelFor(figures.size(), threads, [&](std::size_t i) {
    Rng rng(seed, first + i);
    figures[i] = generateFigure(rng, options);
  });
  return figures;
}

// The net that the first step changes.
JointNet firstNet(const JointTrainingOptions& options, const FigurePlan& plan) {
  const std::string body_plan(plan.body_plan);
  Rng rng(options.seed, kInitialStream);
  if (options.start.empty()) {
    JointNet net = makeJointNet(body_plan, jointNames(plan), std::max(1, options.hourglasses));
    initialise(net, rng);
    return net;
  }
  const JointNet start = parseJointNet(readFile(options.start), options.start);
  if (start.body_plan != body_plan || start.joints != jointNames(plan))
    throw InputError(options.start, "finds the joints of a " + start.body_plan + ", not of a " + body_plan +
                                        " (see --template)");
  if (start.maps[0].channels != kNetInputChannels)
    throw InputError(options.start,
                     "comes from a former version of skel-train; it can be used, but not trained on");
  if (options.hourglasses != 0 && options.hourglasses < start.hourglasses)
    throw UsageError("--hourglasses: " + options.start + " has " + std::to_string(start.hourglasses) +
                     ", which can grow but not shrink");
  return grown(start, std::max(start.hourglasses, options.hourglasses), rng);
}

// What other options decide over when they are not given comes behind those, which are named first.
MadeBy madeJointsBy(const JointTrainingOptions& options, const Schedule& schedule, const JointNet& first,
                    const std::vector<JointedDrawing>& drawings,
                    const std::vector<JointedDrawing>& rehearsed) {
  MadeBy made_by{{schedule.steps}, {}};
  made_by.add("skel-train", "joints");
  made_by.add("--template", options.body_plan);
  made_by.add("--start", contentOfFile(options.start));
  made_by.add("--drawings", contentOf(drawings));
  made_by.add("--rehearse", contentOf(rehearsed));
  made_by.add("--hourglasses", first.hourglasses);
  made_by.add("--seed", std::to_string(options.seed));
  made_by.add("--batch", options.batch);
  made_by.add("--rate", schedule.peak_rate);
  made_by.add("--weight-decay", options.weight_decay);
  made_by.add("--averaging", schedule.averaging);
  made_by.add("--figures", options.figures_per_round);
  made_by.add("--passes", options.passes);
  made_by.add("--others", options.other_share);
  made_by.add("--no-look", options.no_look_share);
  made_by.add("--no-colours", options.no_colours_share);
  made_by.add("--drawn", schedule.drawn_share);
  made_by.add("--hard", options.hard_copies);
  made_by.add("--left-out", schedule.left_out);
  std::ostringstream held_back;
  for (const int kind : options.held_back) held_back << (held_back.tellp() > 0 ? " " : "") << kind;
  made_by.add("--hold-back", options.held_back.empty() ? "none" : held_back.str());
  made_by.add("--validation", options.validation_figures);
  return made_by;
}

class Training {
 public:
  explicit Training(const JointTrainingOptions& options)
      : options_(options),
        schedule_(scheduleOf(options)),
        set_(bestInstructionSet()),
        plan_(figurePlan(options.body_plan)),
        net_(firstNet(options, plan_)),
        joints_(netJoints(net_.joints, loadTemplate(net_.body_plan))),
        trainer_(net_, {schedule_.steps, options.batch, schedule_.peak_rate, options.weight_decay,
                        schedule_.averaging, options.threads}) {
    for (const int kind : options.held_back)
      if (kind >= static_cast<int>(plan_.kinds.size()))
        throw UsageError("--hold-back: there is no body kind " + std::to_string(kind) + "; the last is " +
                         std::to_string(plan_.kinds.size() - 1));
    if (!options.held_back.empty() && kindsOf(plan_, options.held_back, false).empty())
      throw UsageError("--hold-back leaves no body kind to train on");
    if (options.batch > options.figures_per_round * options.passes)
      throw UsageError("--batch " + std::to_string(options.batch) + ": a round has only " +
                       std::to_string(options.figures_per_round * options.passes) +
                       " figures (--figures times --passes)");
    if (options.hard_copies > 1 && (options.start.empty() || options.drawings.empty()))
      throw UsageError("--hard needs --start and --drawings: hard is what that net gets wrong");
    figure_options_.body_plan = net_.body_plan;
    if (!options.held_back.empty()) figure_options_.kinds = kindsOf(plan_, options.held_back, false);
    figure_options_.other_share = options.other_share;
    FigureOptions validation = figure_options_;
    if (!options.rehearsed.empty() && (options.start.empty() || options.drawings.empty()))
      throw UsageError(
          "--rehearse needs --start and --drawings: what that net knows, and what it is to learn");
    const SkeletonTemplate body_plan = loadTemplate(net_.body_plan);
    std::vector<JointedDrawing> drawings = findJointedDrawings(options.drawings, body_plan),
                                rehearsed = findJointedDrawings(options.rehearsed, body_plan);
    made_by_ = madeJointsBy(options, schedule_, net_, drawings, rehearsed);
    ensureWritableFile(options.output);
    goOnFrom(options.checkpoint, made_by_, trainer_);
    if (!drawings.empty()) {
      splitOff(drawings);
      dropLeftOut(rehearsed);
      own_ = drawings.size();
      repeatHard(drawings);
      learned_ = drawings.size();
      std::move(rehearsed.begin(), rehearsed.end(), std::back_inserter(drawings));
      drawings_ = posableDrawings(drawings, net_.joints, body_plan, options.threads);
      shown_ = inEqualShares(learned_, drawings_.size() - learned_);
      figure_options_.drawn_share = schedule_.drawn_share;
    }
    if (!options.held_back.empty()) validation.kinds = kindsOf(plan_, options.held_back, true);
    validation_ = drawFigures(options.seed ^ 0x5eed, kValidationStream, options.validation_figures,
                              validation, options.threads);
  }

  void run() {
    const int steps_per_round = options_.figures_per_round * options_.passes / options_.batch;
    reportDrawings();
    reportLeftOut("before", net_);
    ProgressBar bar("training", static_cast<std::size_t>(schedule_.steps));
    bar.advance(static_cast<std::size_t>(trainer_.steps()));
    if (trainer_.done()) write();
    std::int64_t round = -1;
    double loss = 0;
    int counted = 0;
    while (!trainer_.done()) {
      if (trainer_.steps() / steps_per_round != round) {
        round = trainer_.steps() / steps_per_round;
        figure_options_.drawings.clear();  // two rounds' would not fit everywhere
        figure_options_.drawings = poseDrawings(round);
        figures_ = drawFigures(options_.seed,
                               kFigureStream + static_cast<std::uint64_t>(round * options_.figures_per_round),
                               options_.figures_per_round, figure_options_, options_.threads);
        shuffle(round);
      }
      loss += step(static_cast<std::size_t>(trainer_.steps() % steps_per_round));
      ++counted;
      bar.advance();
      if (trainer_.steps() % options_.report_every == 0 || trainer_.done()) {
        report(bar, loss / counted);
        loss = 0;
        counted = 0;
      }
    }
    reportLeftOut("after", result());
    std::printf("wrote %s\n", printable(options_.output).c_str());
  }

 private:
  // The numbers of `first` and then of `second` things, those of the smaller group as often as it takes to
  // have about as many as the larger.
  static std::vector<std::size_t> inEqualShares(std::size_t first, std::size_t second) {
    const auto copies = [](std::size_t of, std::size_t other) {
      return std::max<std::size_t>(1, (other + of / 2) / std::max<std::size_t>(1, of));
    };
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < first + second; ++i)
      numbers.insert(numbers.end(), i < first ? copies(first, second) : copies(second, first), i);
    return numbers;
  }

  static std::vector<std::string> imagesOf(const std::vector<JointedDrawing>& drawings) {
    std::vector<std::string> images;
    for (const JointedDrawing& drawing : drawings) images.push_back(drawing.image);
    return images;
  }

  static std::vector<std::string> picturesOf(const std::vector<JointedDrawing>& drawings) {
    std::vector<std::string> sha256s;
    for (const JointedDrawing& drawing : drawings) sha256s.push_back(sha256(readFile(drawing.image)));
    return sha256s;
  }

  // Every so many pictures one that only measures, if there are enough.
  void splitOff(std::vector<JointedDrawing>& drawings) {
    const std::vector<std::string> sha256s = picturesOf(drawings);
    const std::vector<std::vector<std::size_t>> pictures = groupedByPicture(sha256s);
    const auto count =
        static_cast<std::size_t>(std::lround(schedule_.left_out * static_cast<double>(pictures.size())));
    if (count == 0 || count >= pictures.size()) return;
    if (const std::string twins = twinsSaid("drawings", imagesOf(drawings), sha256s); !twins.empty())
      std::fprintf(stderr, "skel-train: note: %s: they are left out together\n", twins.c_str());
    std::vector<JointedDrawing> rest;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const bool out = (i + 1) * count / pictures.size() > i * count / pictures.size();
      for (const std::size_t d : pictures[i]) (out ? left_out_ : rest).push_back(drawings[d]);
    }
    drawings = std::move(rest);
  }

  // What only measures is not rehearsed either.
  void dropLeftOut(std::vector<JointedDrawing>& rehearsed) const {
    const std::vector<std::string> left_out = picturesOf(left_out_);
    std::vector<JointedDrawing> dropped;
    std::erase_if(rehearsed, [&](const JointedDrawing& drawing) {
      const bool out =
          std::find(left_out.begin(), left_out.end(), sha256(readFile(drawing.image))) != left_out.end();
      if (out) dropped.push_back(drawing);
      return out;
    });
    if (!dropped.empty())
      std::fprintf(stderr, "skel-train: note: %s: left out to measure by, so not rehearsed\n",
                   firstFew(imagesOf(dropped)).c_str());
  }

  // Drawings that the first net does not know yet are drawn more often.
  void repeatHard(std::vector<JointedDrawing>& drawings) const {
    if (options_.hard_copies == 1) return;
    const std::vector<JointAccuracy> known =
        jointAccuracies(drawings, net_, loadTemplate(net_.body_plan), options_.threads);
    std::vector<JointedDrawing> hard;
    for (std::size_t i = 0; i < drawings.size(); ++i)
      if (known[i].within_10 < 1) hard.push_back(drawings[i]);
    std::printf("%zu of %zu drawings are hard\n", hard.size(), drawings.size());
    std::fflush(stdout);
    for (int copy = 1; copy < options_.hard_copies; ++copy)
      drawings.insert(drawings.end(), hard.begin(), hard.end());
  }

  void reportDrawings() const {
    if (own_ == 0) return;
    std::printf("%zu drawings are learned from", own_);
    if (learned_ < drawings_.size()) std::printf(", %zu rehearsed", drawings_.size() - learned_);
    if (!left_out_.empty())
      std::printf(", %zu left out to measure by\n", left_out_.size());
    else
      std::printf("; none is left out to measure by (%s)\n",
                  schedule_.left_out > 0 ? "they are too few for --left-out" : "--left-out 0");
    std::fflush(stdout);
  }

  void reportLeftOut(const char* when, const JointNet& net) const {
    if (left_out_.empty()) return;
    const JointAccuracy a =
        mean(jointAccuracies(left_out_, net, loadTemplate(net.body_plan), options_.threads));
    std::printf("%s: %zu drawings left out: joints within 5 %% %.3f, within 10 %% %.3f, usable %.2f\n", when,
                left_out_.size(), a.within_5, a.within_10, a.usable);
    std::fflush(stdout);
  }

  // Each drawing as it is and in some other poses.
  std::vector<SmallDrawing> poseDrawings(std::int64_t round) const {
    std::vector<SmallDrawing> drawn(shown_.size() * (1 + kPoses));
    parallelFor(drawn.size(), options_.threads, [&](std::size_t i) {
      const PosableDrawing& drawing = drawings_[shown_[i / (1 + kPoses)]];
      Rng rng(options_.seed, kPoseStream + static_cast<std::uint64_t>(round) * drawn.size() + i);
      switch (i % (1 + kPoses)) {
        case 0:
          drawn[i] = asDrawn(drawing);
          break;
        case 1:
          drawn[i] = posed(rng, drawing);
          break;
        default: {
          const auto donor = rng.below(static_cast<std::uint32_t>(shown_.size()));
          drawn[i] = withLimbsOf(rng, drawing, drawings_[shown_[donor]]);
        }
      }
    });
    return drawn;
  }

  // The order of a round: each pass sees every figure once.
  void shuffle(std::int64_t round) {
    Rng rng(options_.seed, kStepStream - 1 - static_cast<std::uint64_t>(round));
    order_.clear();
    for (int pass = 0; pass < options_.passes; ++pass) {
      const std::size_t first = order_.size();
      for (int i = 0; i < options_.figures_per_round; ++i) order_.push_back(i);
      for (std::size_t i = order_.size() - 1; i > first; --i) {
        std::swap(order_[i], order_[first + rng.below(static_cast<std::uint32_t>(i - first + 1))]);
      }
    }
  }

  double step(std::size_t step_of_round) {
    const std::size_t first = step_of_round * static_cast<std::size_t>(options_.batch);
    std::vector<FramePlacement> placements(static_cast<std::size_t>(options_.batch));
    return trainer_.step(
        {[&](int b, std::vector<float>& input) {
           Rng rng(options_.seed,
                   kStepStream + static_cast<std::uint64_t>(trainer_.steps() * options_.batch + b));
           const Figure& figure = figures_[order_[first + b]];
           const Sample sample = augmented(rng, figure, options_);
           placements[b] = sample.placement;
           encodeJointNetInput(figure.mask, sample.look, sample.placement, net_.maps[0].channels, input);
         },
         [&](int b, const std::vector<float>& output, std::vector<float>& gradient) {
           return jointLoss<float>(output, jointTarget(figures_[order_[first + b]], placements[b], joints_),
                                   1. / options_.batch, &gradient);
         }});
  }

  // The net as its file holds it.
  JointNet result() const {
    JointNet net = net_;
    net.parameters = trainer_.averaged();
    quantize(net);
    return net;
  }

  // The net and the checkpoint.
  Report write() {
    JointNet net = result();
    const Report r = validate(net, joints_, set_, validation_, options_.threads);
    std::ostringstream provenance;
    provenance << "skel-train joints: seed " << options_.seed << ", step " << trainer_.steps() << " of "
               << stepsOf(made_by_) << ", batch " << options_.batch;
    if (!drawings_.empty())
      provenance << ", " << learned_ << " drawings for " << schedule_.drawn_share << " of the figures";
    if (learned_ < drawings_.size()) provenance << " with " << drawings_.size() - learned_ << " rehearsed";
    provenance << ", validation loss " << r.loss << ", within 10 % " << r.within_10;
    net.provenance = provenance.str();
    writeFile(options_.output, formatJointNet(net));
    keepCheckpoint(options_.checkpoint, made_by_, trainer_);
    return r;
  }

  void report(ProgressBar& bar, double loss) {
    const Report r = write();
    bar.clear();
    std::printf("step %lld  loss %.4f  validation: loss %.4f  within 10 %% %.4f  5 %% %.4f  whole %.4f\n",
                static_cast<long long>(trainer_.steps()), loss, r.loss, r.within_10, r.within_5,
                r.whole_right);
    std::fflush(stdout);
  }

  JointTrainingOptions options_;
  Schedule schedule_;
  InstructionSet set_;
  const FigurePlan& plan_;
  JointNet net_;
  NetJoints joints_;
  MadeBy made_by_;
  ConvNetTrainer trainer_;
  FigureOptions figure_options_;
  std::vector<PosableDrawing> drawings_;
  std::size_t own_ = 0;      // drawings that are learned from
  std::size_t learned_ = 0;  // of drawings_, hard ones as often as they count; the others are rehearsed
  std::vector<std::size_t> shown_;  // numbers of drawings_, which a round shows
  std::vector<JointedDrawing> left_out_;
  std::vector<Figure> validation_, figures_;
  std::vector<int> order_;
};

}  // namespace

void bindJointTrainingOptions(CLI::App& command, JointTrainingOptions& options) {
  command.add_option("--template", options.body_plan, "Body plan, by the name of its template")
      ->capture_default_str();
  command.add_option("-o,--output", options.output, "Weights file to write")
      ->capture_default_str()
      ->check(outputFile("skel-joint-net"));
  command
      .add_option(
          "--start", options.start,
          "Net to go on from, with drawings of your own: few steps, a low rate, every fifth drawing measures")
      ->type_name("FILE");
  command.add_option("--checkpoint", options.checkpoint, "File to go on from, and to write at each report")
      ->check(outputFile(kAnyFormat));
  command
      .add_option("--hourglasses", options.hourglasses,
                  "Of the net, one behind another; what the net of --start lacks of them is added")
      ->check(numberIn(1, kMaxHourglasses))
      ->default_str("1, with --start as many as that has");
  command.add_option("--seed", options.seed, "Of all random numbers")
      ->check(seedNumber())
      ->capture_default_str();
  const auto preset = [](auto Schedule::*value) {
    std::ostringstream text;
    text << kFromNothing.*value << ", with --start " << kGoingOn.*value;
    if (kRehearsing.*value != kGoingOn.*value) text << ", with --rehearse " << kRehearsing.*value;
    return text.str();
  };
  command.add_option("--steps", options.steps)
      ->check(numberIn(1, 10'000'000))
      ->default_str(preset(&Schedule::steps));
  command.add_option("--batch", options.batch, "Figures a step")
      ->check(numberIn(4, 1024))
      ->capture_default_str();
  command.add_option("--rate", options.peak_rate, "Highest learning rate")
      ->check(numberIn(1e-9, 1.))
      ->default_str(preset(&Schedule::peak_rate));
  command.add_option("--weight-decay", options.weight_decay)->check(numberIn(0., 1.))->capture_default_str();
  command.add_option("--averaging", options.averaging, "Of the weights over steps")
      ->check(numberIn(0., .999999))
      ->default_str(preset(&Schedule::averaging));
  command.add_option("--figures", options.figures_per_round, "Figures drawn anew each round")
      ->check(numberIn(64, 1'000'000))
      ->capture_default_str();
  command.add_option("--passes", options.passes, "Passes over them")
      ->check(numberIn(1, 100))
      ->capture_default_str();
  command.add_option("--others", options.other_share, "Share of figures that are not whole")
      ->check(numberIn(0., .9))
      ->capture_default_str();
  command
      .add_option("--no-look", options.no_look_share,
                  "Share of figures of which only the silhouette is shown")
      ->check(numberIn(0., 1.))
      ->capture_default_str();
  command
      .add_option("--no-colours", options.no_colours_share, "Share of the others that show only their lines")
      ->check(numberIn(0., 1.))
      ->capture_default_str();
  command
      .add_option("--drawings", options.drawings,
                  "Drawings with known joints: trained on besides, each time posed and warped anew. Either\n"
                  "*.joints.json and *.mask.png, or what skel-label saves: *.skeleton.json, *.labels.json")
      ->type_name("DIR")
      ->take_all();
  command
      .add_option(
          "--rehearse", options.rehearsed,
          "Drawings that the net of --start knows, lest it forgets: as many figures come from them as\n"
          "from --drawings")
      ->type_name("DIR")
      ->take_all();
  command
      .add_option("--drawn", options.drawn_share, "Share of figures that come from --drawings and --rehearse")
      ->check(numberIn(0., 1.))
      ->default_str(preset(&Schedule::drawn_share));
  command
      .add_option("--hard", options.hard_copies,
                  "How often a drawing counts of which the net of --start gets a joint wrong by 10 %")
      ->check(numberIn(1, 100))
      ->capture_default_str();
  command
      .add_option("--left-out", options.left_out, "Share of the drawings that only measure, before and after")
      ->check(numberIn(0., .9))
      ->default_str(preset(&Schedule::left_out));
  command
      .add_option("--hold-back", options.held_back, "Body kinds to validate on instead of training on them")
      ->check(numberIn(0, 99));
  command.add_option("--threads", options.threads, "0: one a core")
      ->check(numberIn(0, 256))
      ->capture_default_str();
  command
      .add_option("--validation", options.validation_figures, "Generated figures that a report measures on")
      ->check(numberIn(1, 1'000'000))
      ->capture_default_str();
  command.add_option("--report-every", options.report_every, "Steps")
      ->check(numberIn(1, 1'000'000))
      ->capture_default_str();
}

ExitCode runJointTraining(const JointTrainingOptions& options) {
  Training(options).run();
  return ExitCode::kDone;
}

}  // namespace skel
