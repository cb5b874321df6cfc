#include "libskel/style/transfer.h"

#include <Eigen/QR>
#include <algorithm>
#include <set>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/style/in_between.h"
#include "libskel/style/semantics.h"

namespace skel {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

void check(const std::vector<MotionPair>& pairs) {
  if (pairs.empty()) throw UsageError("there is no motion to transfer");
  for (const MotionPair& pair : pairs) {
    if (pair.content.cols() == 0 || pair.style.cols() == 0)
      throw UsageError("a motion to transfer has no frames");
    SKEL_CHECK_EQ(pair.content.rows(), pair.style.rows());
  }
}

MatrixXd besides(const std::vector<MotionPair>& pairs, PoseMatrix MotionPair::*part) {
  Index count = 0;
  for (const MotionPair& pair : pairs) count += (pair.*part).cols();
  MatrixXd all(pairs[0].content.rows(), count);
  Index at = 0;
  for (const MotionPair& pair : pairs) {
    all.middleCols(at, (pair.*part).cols()) = pair.*part;
    at += (pair.*part).cols();
  }
  return all;
}

std::vector<PoseMatrix> split(const MatrixXd& all, const std::vector<MotionPair>& pairs) {
  std::vector<PoseMatrix> parts;
  Index at = 0;
  for (const MotionPair& pair : pairs) {
    parts.push_back(all.middleCols(at, pair.content.cols()));
    at += pair.content.cols();
  }
  return parts;
}

}  // namespace

Transfer transferStyle(const std::vector<MotionPair>& pairs, const TransferOptions& options) {
  check(pairs);
  Transfer result;
  std::vector<MotionPair> aligned = pairs;
  for (MotionPair& pair : aligned) {
    result.alignments.push_back(alignPhases(
        pair.content, pair.style,
        {pair.content_loops, pair.style_loops, pair.content_path, pair.style_path, options.on_beginning}));
    pair.style = posesAt(pair.style, result.alignments.back().style_frame, pair.style_loops);
  }
  for (MotionPair& pair : aligned) {
    if (pair.keys.empty()) continue;
    pair.content = pair.content(Eigen::all, pair.keys).eval();
    pair.style = pair.style(Eigen::all, pair.keys).eval();
  }
  const MatrixXd content = besides(aligned, &MotionPair::content),
                 style = besides(aligned, &MotionPair::style);
  const Index rows = content.rows();
  MatrixXd both(2 * rows, content.cols());
  both << content, style;
  SparseCodingOptions coding = options.coding;
  Eigen::ColPivHouseholderQR<MatrixXd> independent;
  independent.setThreshold(1e-6);
  independent.compute(both);
  coding.components = std::min(coding.components, std::max(1, int(independent.rank())));
  result.coding = sparseCoding(both, coding);
  const MatrixXd change =
      (result.coding.basis.bottomRows(rows) - result.coding.basis.topRows(rows)) * result.coding.activations;
  result.poses = split(content + options.amount * change, aligned);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!pairs[i].keys.empty())
      result.poses[i] = inBetweens(pairs[i].content, pairs[i].keys, result.poses[i], pairs[i].content_loops);
  return result;
}

Transfer transferBySignatures(const std::vector<MotionPair>& pairs, const std::vector<std::string>& actions,
                              const TransferOptions& options) {
  check(pairs);
  SKEL_CHECK_EQ(pairs.size(), actions.size());
  const std::set<std::string> classes(actions.begin(), actions.end());
  if (int(classes.size()) < options.coding.components)
    throw UsageError(
        "matching " + std::to_string(options.coding.components) +
        " components by their signatures needs as many action classes that both show; there are " +
        std::to_string(classes.size()));
  const auto actionsOf = [&](PoseMatrix MotionPair::*part) {
    std::vector<std::string> of;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      of.insert(of.end(), std::size_t((pairs[i].*part).cols()), actions[i]);
    return of;
  };
  const MatrixXd content = besides(pairs, &MotionPair::content), style = besides(pairs, &MotionPair::style);
  Transfer result;
  result.coding = sparseCoding(content, options.coding);
  const SparseCoding theirs = sparseCoding(style, options.coding);
  const std::vector<int> match =
      matchSignatures(fitSemantics(result.coding.activations, actionsOf(&MotionPair::content)).class_weights,
                      fitSemantics(theirs.activations, actionsOf(&MotionPair::style)).class_weights);
  MatrixXd basis(theirs.basis.rows(), theirs.basis.cols());
  for (std::size_t c = 0; c < match.size(); ++c) basis.col(Index(c)) = theirs.basis.col(match[c]);
  result.poses =
      split(content + options.amount * (basis - result.coding.basis) * result.coding.activations, pairs);
  return result;
}

}  // namespace skel
