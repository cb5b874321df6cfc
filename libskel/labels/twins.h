// Pictures that occur more than once in a set: copies, or one that several people have labelled.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "libskel/labels/label_file.h"

namespace skel {

// The numbers of those that are one picture, by the SHA-256 of its bytes ("": not known, a picture of its
// own). Each is in one group; both groups and numbers come in their order.
std::vector<std::vector<std::size_t>> groupedByPicture(const std::vector<std::string>& sha256s);

// "2 characters are one picture (a, b)", and how many more pictures occur more than once; "": none does.
// `things`: what they are called, by `names`.
std::string twinsSaid(const std::string& things, const std::vector<std::string>& names,
                      const std::vector<std::string>& sha256s);

// What is to be said behind that: ", their joints lie up to .08 of the figure apart"; "": not by .01.
// `joints`: that people have placed in each of them; `figure_px`: the long side of one's figure, 0 where it
// is not known.
std::string twinJointsSaid(const std::vector<std::string>& sha256s, const std::vector<NamedJoints>& joints,
                           const std::function<double(std::size_t)>& figure_px);

}  // namespace skel
