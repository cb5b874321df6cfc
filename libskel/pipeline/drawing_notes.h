// What a person should know of a drawing that was rigged.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/pipeline/rig_character.h"

namespace skel {

// One clause. "skel-label FILE" in it stands for the command that opens what mends the drawing, NAME in
// "--facing NAME" for its name.
struct Note {
  std::string text;
  // Where many drawings are spoken of, the same is said once of all: `text` without what differs, which is
  // `what`. Empty: `text` has nothing that differs.
  std::string shared = {}, what = {};
};

// The note's text for a drawing whose file to mend is `file`, with the command as a shell takes it here.
std::string noteText(const Note& note, const std::string& file);

// Of the figure, its joints and its body plan, where the joints were looked for.
std::vector<std::string> figureNotes(const RiggedDrawing& drawing);

// `notes`, of which the one that the figure is turned says what to do if it is not: `advice`.
std::vector<std::string> withAdviceIfUpright(std::vector<std::string> notes, const std::string& advice);

// A clause for each arm that is cut out and of whose upper half next to nothing is drawn, as behind the head:
// what is seen of it comes off the body when it moves.
std::vector<std::string> partlyDrawnNotes(const RiggedDrawing& drawing);

// Where it is taken to look to a side that it may not look to.
std::optional<std::string> facingNote(const RiggedCharacter& character);

// Of limbs that these clips, which are relative to the rest pose, do not move as limbs should; nothing where
// the joints are a guess.
std::vector<Note> limbNotes(const RiggedDrawing& drawing, const std::vector<Clip>& clips);

// Of arms that lie against the body and stay as they are drawn (LayerMap::at_rest).
std::optional<Note> restNote(const RiggedDrawing& drawing);

// Of arms that do not follow these clips, which are for the canonical pose.
std::vector<Note> armNotes(const RiggedCharacter& character, const std::vector<Clip>& clips);

}  // namespace skel
