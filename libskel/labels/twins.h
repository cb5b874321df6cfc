// Pictures that occur more than once in a set: copies, or one that several people have labelled.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace skel {

// The numbers of those that are one picture, by the SHA-256 of its bytes ("": not known, a picture of its
// own). Each is in one group; both groups and numbers come in their order.
std::vector<std::vector<std::size_t>> groupedByPicture(const std::vector<std::string>& sha256s);

// "2 characters are one picture (a, b)", and how many more pictures occur more than once; "": none does.
// `things`: what they are called, by `names`.
std::string twinsSaid(const std::string& things, const std::vector<std::string>& names,
                      const std::vector<std::string>& sha256s);

}  // namespace skel
