// Who has drawn what, so that what is learned from some hands is measured on others.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace skel {

struct Hands {
  std::map<std::string, std::string> of_drawing;
  std::set<std::string> learned;  // drawings of the hands before the first one

  // Who has drawn it; one that nobody is known of has a hand of its own.
  const std::string& of(const std::string& drawing) const;
};

// `file`: a JSON object of lists of names of drawings, by hand; "": none is known. What the hands before
// `first_hand` drew, nets have learned from; "": nothing. Throws InputError and UsageError.
Hands readHands(const std::string& file, const std::string& first_hand = "");

// Of each drawing its group of 0 to folds - 1, for cross-validation: all of a hand's are in one.
std::map<std::string, int> foldOfDrawing(const std::vector<std::string>& drawings, const Hands& hands,
                                         int folds);

}  // namespace skel
