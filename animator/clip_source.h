// Motions, as the commands of skel-animate name them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/animation/clip_file.h"
#include "libskel/animation/retarget_motion.h"
#include "libskel/core/error.h"
#include "libskel/import/read_character.h"

namespace CLI {
class App;
}

namespace skel {

struct ClipSource {
  std::string clips_dir;                // a folder of clip files beside those that come with skel
  std::vector<std::string> names;       // that are asked for of the folder
  std::string interpolation = "slerp";  // of files of the elk system: slerp, or linear on the angles
  std::string clip_up = "z";            // of files of the elk system: the axis that points up
  double into_picture = RetargetOptions().into_picture;
  bool into_picture_given = false;  // by the user
  // For the drawing itself as a cut-out: what is made for the figure's own directions (a walk, others'
  // motions) turns into the picture all the way, unless the user says how far.
  bool flat = false;
};
// --clips-dir, --interpolation, --clip-up, --into-picture.
void bindClipSource(CLI::App& app, ClipSource& source);

// Those that come with skel, and those of the folder. `left_out` (or null): which files of it are no clips.
std::vector<Clip> clipLibrary(const ClipSource& source, std::vector<std::string>* left_out = nullptr);
// The clip file of the folder that is called so, whatever its clip is called; "": there is none.
std::string clipFileNamed(const std::string& name, const ClipSource& source);
// clipLibrary(), and says on stderr what is left out.
std::vector<Clip> toldClipLibrary(const ClipSource& source);

// Those of `library` that this character can do: by the names of its joints, or by their parts in it
// (role_figure.h).
std::vector<Clip> clipsFor(const std::vector<Clip>& library, const RiggedCharacter& character);

// What is wrong with a clip that the character cannot do, a clause after the clip's name; "": none can tell.
std::string whyUnfit(const Clip& clip, const RiggedCharacter& character);

// What is to be said of a clip: what the character does not do of it, and what its arms do not, in clauses.
struct ClipNotes {
  std::string of_file;  // what is not used of the file that it was read from, a line with its name; or ""
  std::vector<std::string> of_character, of_arms;
};

// Of clips that fit the character and are for the canonical pose: that one is for another body plan, or for
// joints that it lacks, and which arms stay (armsThatStay()).
ClipNotes whatStays(const std::vector<Clip>& clips, const RiggedCharacter& character);

// Made for the canonical pose; the result is for the character's rest pose.
Clip fitted(const Clip& clip, const RiggedCharacter& character, const ClipSource& source = {});

// The motion of a .bvh, fitted to the character, and which joints were matched. Throws InputError.
RetargetedMotion loadBvhFor(const std::string& path, const RiggedCharacter& character,
                            const ClipSource& source = {});

// To be written as a clip file of this character: it knows its rest pose and, where the clip names none, its
// body plan.
ClipKeys madeFor(const Skeleton& skeleton, ClipKeys keys);

// A clip file for another body plan than the character's, whose joints this lacks.
class OtherBodyPlan : public InputError {
 public:
  using InputError::InputError;
};

// A clip file, ours or of the elk system, or a .bvh, fitted to the character. `notes` may be null. Throws
// InputError, of which OtherBodyPlan is one.
Clip loadClipFor(const std::string& path, const RiggedCharacter& character, const ClipSource& source = {},
                 ClipNotes* notes = nullptr);
// Of a clip file whose keys ease, these keys; else nothing. Throws InputError.
std::optional<ClipKeys> easedKeysIn(const std::string& path);
// The same of one that is for this very rest pose (Clip::rest_pose).
std::optional<ClipKeys> easedKeysOf(const std::string& path, const Skeleton& skeleton);
// The same of all clip files of the folder.
std::vector<ClipKeys> easedKeysOf(const ClipSource& source, const Skeleton& skeleton);

}  // namespace skel
