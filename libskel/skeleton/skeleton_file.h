// `<stem>.skeleton.json`: a skeleton that people may look at, mend by hand and hand back.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/skeleton/skeleton.h"
#include "libskel/skeleton/template.h"

namespace skel {

struct SkeletonFile {
  struct Mask {
    std::string file;
    std::string sha256;
    bool before = false;  // it was there before the picture changed, and nobody has looked at it since
  };
  struct Labels {
    std::string file;
    std::string sha256;
    std::map<std::string, Eigen::Vector2d> joints = {};  // that a person placed there; not before version 6
  };

  // Which figure of the drawing it is.
  struct Figure {
    int number = 1;      // 1 is the largest
    std::string sha256;  // of its outline (outlineHash()); empty: not known
    int turned_deg = 0;  // how far it is turned clockwise against upright, 0 to 359
    // Where a mask was used, of the outline that the picture alone gives; empty: not known.
    std::string found_sha256 = {};
    // Which way it looks, as a person has said: about the vertical, 0 to the viewer, 90 to the right of the
    // picture, -180 to 180.
    std::optional<double> facing_deg = {};
  };

  std::string image_file;    // a path relative to the skeleton file
  std::string image_sha256;  // of its bytes; empty: not known
  int image_width = 0, image_height = 0;
  Figure figure;
  Skeleton skeleton;
  double confidence = 0;
  std::vector<std::string> missing;  // joints that were not found in the drawing
  std::vector<std::string> warnings;
  std::optional<Mask> mask;      // given or mended by hand
  std::optional<Mask> limbs;     // painted by hand in a file of their own, which nobody has named
  std::optional<Labels> labels;  // whose joints, placed by a person, are among these

  // Of the outline that the picture alone gives; empty: not known.
  const std::string& foundOutline() const { return mask ? figure.found_sha256 : figure.sha256; }
};

inline constexpr const char* kSkeletonFileEnding = ".skeleton.json";

// Those of `files` belong to what a command works on, whether it reads them or not: notes them as inputs, so
// that no output replaces what a person has mended in them. Throws OverwriteError (input_guard.h).
void noteSkeletonFiles(const std::vector<std::string>& files);

// Each joint that no person has placed stands there twice: what is moved is `image`, `found` says from where.
std::string formatSkeletonFile(const SkeletonFile& file);

// Throws InputError: joints that are not the template's (any order), outside the image, of another parent,
// NaN. Positions are read as they stand; the pipeline computes them anew from `image`. A joint that somebody
// has moved without saying so, as `found` tells (before version 4: moved_joints.h), comes back as edited,
// sure (mark_placed.h) and not missing.
SkeletonFile readSkeletonFile(const std::string& path, const SkeletonTemplate& body_plan);
// `path` is the name that complaints use.
SkeletonFile parseSkeletonFile(std::string_view text, const std::string& path,
                               const SkeletonTemplate& body_plan);

// The name of the template that a skeleton file belongs to. Throws InputError: no skeleton file.
std::string templateOfSkeleton(std::string_view text, const std::string& path);

// What a skeleton was found in; hashes are empty where they are not known.
struct SkeletonSource {
  std::string image_file;  // a path relative to the skeleton file
  std::string image_sha256, outline_sha256;
  std::string found_outline_sha256;       // SkeletonFile::foundOutline()
  int image_width = 0, image_height = 0;  // px
  int number = 1;                         // of the figure
  std::optional<double> facing_deg;       // SkeletonFile::Figure::facing_deg
  std::optional<SkeletonFile::Mask> mask, limbs;
  std::optional<SkeletonFile::Labels> labels;
  std::vector<std::string> warnings;  // of what was found
};

// Of the skeleton file at `path`. Throws InputError.
SkeletonSource readSkeletonSource(const std::string& path);
// The same. Nothing where there is none, or none that can be read.
std::optional<SkeletonSource> sourceOfSkeleton(const std::string& path);

// How many joints a person has moved in the skeleton file at `path`, said so or not. None where there is no
// file. Throws InputError: no JSON.
std::size_t editedJoints(const std::string& path);
inline bool hasEditedJoint(const std::string& path) { return editedJoints(path) > 0; }

// Whether it has a joint that its template, biped or quadruped, has not: somebody has mistyped a name. False
// where there is no file. Throws InputError: no JSON.
bool hasUnknownJoint(const std::string& path);

// Whether two files mean one place of a joint, px: skeleton files keep its hundredths.
bool isSamePlace(const Eigen::Vector2d& place, const Eigen::Vector2d& other);

// Whether two skeleton files have the same joints at the same places, to the hundredth of a pixel that files
// keep. Throws InputError: no JSON.
bool haveSameJoints(const std::string& path, const std::string& other_path);

}  // namespace skel
