#include "libskel/labels/twins.h"

#include <map>

#include "libskel/core/text.h"

namespace skel {

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

}  // namespace skel
