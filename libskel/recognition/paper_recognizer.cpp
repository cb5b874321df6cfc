// Shu & Yang (2018), section "skeleton extraction": equations (1) to (3), Algorithm 2.
#include "libskel/recognition/paper_recognizer.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libskel/core/check.h"
#include "libskel/core/segment.h"
#include "libskel/recognition/complete_skeleton.h"
#include "libskel/recognition/joint_note.h"

namespace skel {
namespace {

using Eigen::Vector2d;

Vector2d at(const CandidateSet& candidates, int i) {
  const JointCandidate& c = candidates.maxima[static_cast<size_t>(i)];
  return {c.x, c.y};
}

double radius(const CandidateSet& candidates, int i) {
  return candidates.maxima[static_cast<size_t>(i)].radius;
}

double share(const CandidateLine& line, JointClass c) { return line.class_share[static_cast<size_t>(c)]; }

double meanRadius(const CandidateSet& candidates, const std::vector<int>& members) {
  double sum = 0;
  for (const int i : members) sum += radius(candidates, i);
  return members.empty() ? 0 : sum / static_cast<double>(members.size());
}

// Of the lines that hold any candidate of the class, the one with the largest mean D; null if there is none.
const CandidateLine* thickestLineWith(const std::vector<CandidateLine>& lines, JointClass c) {
  const CandidateLine* best = nullptr;
  for (const CandidateLine& line : lines)
    if (share(line, c) > 0 && (!best || line.mean_radius > best->mean_radius)) best = &line;
  return best;
}

std::vector<int> ofClass(const std::vector<int>& members, const ClassProbabilities& classes, JointClass c) {
  std::vector<int> chosen;
  for (const int i : members) {
    Eigen::Index best;
    classes.row(i).maxCoeff(&best);
    if (best == static_cast<int>(c)) chosen.push_back(i);
  }
  return chosen;
}

struct Trunk {
  Vector2d head, body;  // grid px
};

Vector2d centreOfFigure(const Plane8& mask) {
  Vector2d sum = Vector2d::Zero();
  double count = 0;
  for (int y = 0; y < mask.rows(); ++y)
    for (int x = 0; x < mask.cols(); ++x)
      if (mask(y, x)) sum += Vector2d(x, y), ++count;
  return sum / count;
}

// Algorithm 2. A line mixes classes as soon as limbs touch the trunk, so of the line that counts as head
// (body) only the candidates of that class speak for the joint.
Trunk findTrunk(const Silhouette& silhouette, const CandidateSet& candidates,
                const ClassProbabilities& classes, const std::vector<CandidateLine>& lines) {
  Trunk trunk;
  if (const CandidateLine* line = thickestLineWith(lines, JointClass::kBody)) {
    trunk.body = Vector2d::Zero();
    const std::vector<int> members = ofClass(line->members, classes, JointClass::kBody);
    for (const int i : members) trunk.body += at(candidates, i) / static_cast<double>(members.size());
  } else {
    trunk.body = centreOfFigure(silhouette.grid_mask);
  }
  int head = -1;
  const auto consider = [&](int i) {
    if (head < 0 || radius(candidates, i) > radius(candidates, head)) head = i;
  };
  if (const CandidateLine* line = thickestLineWith(lines, JointClass::kHead))
    for (const int i : ofClass(line->members, classes, JointClass::kHead)) consider(i);
  else
    for (const int i : candidates.kept)
      if (at(candidates, i).y() < trunk.body.y()) consider(i);
  trunk.head = head >= 0 ? at(candidates, head) : Vector2d(trunk.body.x(), trunk.body.y() / 2);
  return trunk;
}

// The line's two candidates that are farthest apart, the one nearer to the body first, and the one most in
// the middle.
std::array<int, 3> limbJoints(const CandidateSet& candidates, const CandidateLine& line,
                              const Vector2d& body) {
  std::array<int, 3> joints = {line.members.front(), line.members.front(), line.members.front()};
  double farthest = -1;
  for (const int a : line.members)
    for (const int b : line.members)
      if (const double d = (at(candidates, a) - at(candidates, b)).norm(); d > farthest)
        farthest = d, joints = {a, a, b};
  if ((at(candidates, joints[0]) - body).norm() > (at(candidates, joints[2]) - body).norm())
    std::swap(joints[0], joints[2]);
  double least = std::numeric_limits<double>::infinity();
  for (const int i : line.members) {
    const double d = std::max((at(candidates, i) - at(candidates, joints[0])).norm(),
                              (at(candidates, i) - at(candidates, joints[2])).norm());
    if (d < least) least = d, joints[1] = i;
  }
  return joints;
}

// Whether the limb's preset lies on the side of the head-body axis where the line lies.
bool sameSide(const SkeletonTemplate& body_plan, const TemplateLimb& limb, const Trunk& trunk,
              const Vector2d& middle) {
  const auto side = [](const Vector2d& head, const Vector2d& body, const Vector2d& p) {
    const Vector2d axis = body - head, to = p - head;
    return axis.x() * to.y() - axis.y() * to.x() > 0;
  };
  const auto preset = [&](int i) { return body_plan.joints[static_cast<size_t>(i)].preset; };
  return side(trunk.head, trunk.body, middle) ==
         side(preset(body_plan.head), preset(body_plan.body), preset(limb.joints[2]));
}

// How far the rules can be trusted: of the joints that they find about half lie within a tenth of the
// figure's size.
constexpr double kFoundByRules = 0.5, kCompletedConfidence = 0.2;

}  // namespace

std::vector<CandidateLine> candidateLines(const CandidateSet& candidates, const std::vector<int>& members,
                                          const ClassProbabilities& classes, double reach) {
  std::vector<int> line_of(members.size());
  std::iota(line_of.begin(), line_of.end(), 0);
  for (size_t a = 0; a < members.size(); ++a)
    for (size_t b = 0; b < a; ++b) {
      const double distance = (at(candidates, members[a]) - at(candidates, members[b])).norm();
      if (distance > reach * (radius(candidates, members[a]) + radius(candidates, members[b]))) continue;
      const int from = line_of[a], to = line_of[b];
      if (from != to) std::replace(line_of.begin(), line_of.end(), from, to);
    }
  std::vector<CandidateLine> lines;
  std::vector<int> index(members.size(), -1);
  for (size_t i = 0; i < members.size(); ++i) {
    int& line = index[static_cast<size_t>(line_of[i])];
    if (line < 0) {
      line = static_cast<int>(lines.size());
      lines.emplace_back();
    }
    lines[static_cast<size_t>(line)].members.push_back(members[i]);
  }
  for (CandidateLine& line : lines) {
    line.mean_radius = meanRadius(candidates, line.members);
    for (int c = 0; c < kJointClassCount; ++c)
      line.class_share[static_cast<size_t>(c)] =
          static_cast<double>(ofClass(line.members, classes, static_cast<JointClass>(c)).size()) /
          static_cast<double>(line.members.size());
  }
  std::stable_sort(lines.begin(), lines.end(), [](const CandidateLine& a, const CandidateLine& b) {
    return a.members.size() > b.members.size();
  });
  return lines;
}

Recognition recognizeByRules(const Silhouette& silhouette, const CandidateSet& candidates,
                             const ClassProbabilities& classes, const SkeletonTemplate& body_plan) {
  SKEL_CHECK(silhouette.found());
  SKEL_CHECK_EQ(classes.rows(), static_cast<Eigen::Index>(candidates.maxima.size()));
  const RecognitionRules& rules = body_plan.rules;
  const Trunk trunk = findTrunk(silhouette, candidates, classes,
                                candidateLines(candidates, candidates.kept, classes, rules.line_reach));

  Recognition recognition;
  recognition.skeleton = presetSkeleton(body_plan, {0, 0}, {1, 1});
  std::vector<bool> found(body_plan.joints.size(), false);
  const auto place = [&](int joint, const Vector2d& grid_point, double confidence) {
    Joint& placed = recognition.skeleton.joints[static_cast<size_t>(joint)];
    placed.image = silhouette.grid.imageFromGrid(grid_point);
    placed.confidence = confidence * kFoundByRules;
    placed.origin = JointOrigin::kRecognized;
    found[static_cast<size_t>(joint)] = true;
  };
  place(body_plan.head, trunk.head, 1);
  place(body_plan.body, trunk.body, 1);

  std::vector<int> beside;
  for (const int i : candidates.kept)
    if (distanceToSegment(at(candidates, i), trunk.head, trunk.body) > radius(candidates, i))
      beside.push_back(i);
  const double mean_radius = meanRadius(candidates, candidates.kept);
  for (const CandidateLine& line : candidateLines(candidates, beside, classes, rules.line_reach)) {
    const double hand = share(line, JointClass::kHand), leg = share(line, JointClass::kLeg);
    if (hand + leg < rules.limb_probability || line.mean_radius > rules.limb_radius * mean_radius) continue;
    const JointClass limb_class = hand >= leg ? JointClass::kHand : JointClass::kLeg;
    const std::array<int, 3> ends = limbJoints(candidates, line, trunk.body);
    for (const TemplateLimb& limb : body_plan.limbs) {
      if (limb.limb_class != limb_class || found[static_cast<size_t>(limb.joints[0])] ||
          !sameSide(body_plan, limb, trunk, at(candidates, ends[1])))
        continue;
      for (size_t k = 0; k < 3; ++k) place(limb.joints[k], at(candidates, ends[k]), hand + leg);
      break;
    }
  }

  double confidence = 0, recognized = 0;
  for (size_t i = 0; i < found.size(); ++i) {
    if (body_plan.joints[i].derived) continue;
    Joint& joint = recognition.skeleton.joints[i];
    if (!found[i]) {
      joint.confidence = kCompletedConfidence;
      recognition.missing.push_back(joint.name);
    }
    confidence += joint.confidence;
    ++recognized;
  }
  recognition.confidence = confidence / recognized;
  recognition.likeness = 1;  // the rules take whatever they are given for a figure
  recognition.warnings.push_back(doubtNote(recognition.missing));  // they don't tell how sure they are
  completeSkeleton(recognition.skeleton, found, body_plan, silhouette);
  return recognition;
}

}  // namespace skel
