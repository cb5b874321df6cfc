#include "trainer/hands.h"

#include "libskel/core/error.h"
#include "libskel/core/json.h"

namespace skel {

const std::string& Hands::of(const std::string& drawing) const {
  const auto at = of_drawing.find(drawing);
  return at == of_drawing.end() ? drawing : at->second;
}

Hands readHands(const std::string& file, const std::string& first_hand) {
  Hands hands;
  if (file.empty()) {
    if (!first_hand.empty()) throw UsageError("--first-hand needs --hands");
    return hands;
  }
  const JsonDocument document = JsonDocument::readFile(file);
  bool learned = !first_hand.empty();
  for (const std::string& hand : document.root().keys()) {
    learned = learned && hand != first_hand;
    for (const JsonValue& name : document.root().at(hand).items()) {
      hands.of_drawing[name.asString()] = hand;
      if (learned) hands.learned.insert(name.asString());
    }
  }
  if (learned) throw UsageError("--first-hand \"" + first_hand + "\": " + file + " knows no such hand");
  return hands;
}

std::map<std::string, int> foldOfDrawing(const std::vector<std::string>& drawings, const Hands& hands,
                                         int folds) {
  std::set<std::string> names;
  for (const std::string& drawing : drawings) names.insert(hands.of(drawing));
  std::map<std::string, int> fold_of_hand, fold_of;
  for (const std::string& name : names)
    fold_of_hand.emplace(name, static_cast<int>(fold_of_hand.size()) % folds);
  for (const std::string& drawing : drawings) fold_of[drawing] = fold_of_hand.at(hands.of(drawing));
  return fold_of;
}

}  // namespace skel
