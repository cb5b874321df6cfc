// The motions that come with skel, and a user's own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/skeleton/template.h"

namespace skel {

// All that come with skel, for the canonical pose: the files of libskel/animation/clips.
const std::vector<Clip>& builtinClips();

bool hasClip(const std::vector<Clip>& clips, const std::string& name);

// Whether it is none of those that come with skel.
bool isOwn(const Clip& clip);

// All that come with skel, and the clip files (kClipFileEnding) of `dir` ("": of none), at any depth; one of
// the same name takes the place of the built-in one for its template, or, without a template, of those for
// all that have its joints. `names`: the clips that are asked for; a file that is no clip and not called
// as one of these, or whose clip is none of these and has the name of one before, is left out, and what is
// wrong with it added to `left_out` (or null). Throws InputError: no folder or none with a clip, a file that
// is asked for and no clip, two clips of a name that is asked for.
std::vector<Clip> clipsWithFolder(const std::string& dir, const std::vector<std::string>& names = {},
                                  std::vector<std::string>* left_out = nullptr);

// Whether the joints are there that the clip moves, those of its template, and limbs for its contacts to end.
bool fits(const Clip& clip, const Skeleton& skeleton);
bool fits(const Clip& clip, const SkeletonTemplate& body_plan);

// What is wrong with a clip that does not fit, to stand behind its name: a template that is none that comes
// with skel, a joint that neither the target nor the clip's template (without one: any) has. Empty where it
// fits or is made for others.
std::string faultOf(const Clip& clip, const Skeleton& skeleton);
std::string faultOf(const Clip& clip, const SkeletonTemplate& body_plan);

// Those of `library` that fit.
std::vector<Clip> clipsFor(const std::vector<Clip>& library, const Skeleton& skeleton);
std::vector<Clip> clipsFor(const std::vector<Clip>& library, const SkeletonTemplate& body_plan);

// Which of `fitting` somebody meant by a name that none of them has: the nearest one, or the same gait of
// another body plan; "": none.
std::string meantClip(std::string_view name, const std::vector<Clip>& fitting);

// The one of this name among `fitting`. Throws UsageError that lists the names there are.
const Clip& clipNamed(const std::vector<Clip>& fitting, std::string_view name);

}  // namespace skel
