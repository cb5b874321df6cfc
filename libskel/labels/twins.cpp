#include "libskel/labels/twins.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "libskel/core/text.h"

namespace skel {
namespace {

// Of the joints that both have placed, px.
double farthestApart(const NamedJoints& some, const NamedJoints& others) {
  double apart_px = 0;
  for (const auto& [name, place] : some)
    for (const auto& [other_name, other] : others)
      if (name == other_name && place && other) apart_px = std::max(apart_px, (*place - *other).norm());
  return apart_px;
}

}  // namespace

std::vector<std::vector<std::size_t>> groupedByPicture(const std::vector<std::string>& sha256s) {
  std::vector<std::vector<std::size_t>> groups;
  std::map<std::string, std::size_t> group_of;
  for (std::size_t i = 0; i < sha256s.size(); ++i) {
    const bool is_first = sha256s[i].empty() || group_of.emplace(sha256s[i], groups.size()).second;
    if (is_first)
      groups.push_back({i});
    else
      groups[group_of.at(sha256s[i])].push_back(i);
  }
  return groups;
}

std::string twinsSaid(const std::string& things, const std::vector<std::string>& names,
                      const std::vector<std::string>& sha256s) {
  std::string text;
  std::size_t more = 0;
  for (const std::vector<std::size_t>& group : groupedByPicture(sha256s)) {
    if (group.size() == 1) continue;
    if (!text.empty()) {
      ++more;
      continue;
    }
    std::vector<std::string> of_group;
    for (const std::size_t i : group) of_group.push_back(names[i]);
    text = std::to_string(group.size()) + " " + things + " are one picture (" + firstFew(of_group) + ")";
  }
  if (more > 0)
    text += ", and so of " + std::to_string(more) + (more == 1 ? " more picture" : " more pictures");
  return text;
}

std::string twinJointsSaid(const std::vector<std::string>& sha256s, const std::vector<NamedJoints>& joints,
                           const std::function<double(std::size_t)>& figure_px) {
  constexpr double kSame = .01;
  double most = 0;
  for (const std::vector<std::size_t>& group : groupedByPicture(sha256s)) {
    double apart_px = 0;
    for (const std::size_t i : group)
      for (const std::size_t j : group) apart_px = std::max(apart_px, farthestApart(joints[i], joints[j]));
    const double size_px = apart_px > 0 ? figure_px(group.front()) : 0;
    if (size_px > 0) most = std::max(most, apart_px / size_px);
  }
  if (most < kSame) return "";
  char share[16];
  std::snprintf(share, sizeof share, "%.2f", most);
  return std::string(", their joints lie up to ") + (most < .995 ? share + 1 : share) +
         " of the figure apart";
}

}  // namespace skel
