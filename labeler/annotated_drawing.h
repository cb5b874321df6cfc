// Drawings that something else has annotated: found in a folder, their joints under our names.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "libskel/core/error.h"
#include "libskel/image/image.h"
#include "libskel/labels/label_file.h"
#include "libskel/labels/label_folder.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/body_plans.h"

namespace skel {

struct AnnotatedDrawing {
  std::string source;                  // the file that the joints come from
  std::string image;                   // path
  std::optional<std::string> mask;     // path
  std::vector<Polygon> mask_polygons;  // instead of a file, image px; empty: none
  NamedJoints joints;
  std::vector<std::string> recognized;    // those of `joints` that no person has placed
  std::vector<std::string> unknown = {};  // what the annotation has and nothing is known of, by name
  bool is_export = false;                 // of our own label files: formatCoco()
  int image_width = 0, image_height = 0;  // px, of the picture that it is for; 0: it does not say
};

// The body plan that has all of the joints; the first where none has.
const SkeletonTemplate& planOf(const NamedJoints& joints, const BodyPlans& plans);

// All below `dir`, by path:
//   char_cfg.yaml with texture.png and mask.png          AnimatedDrawings
//   joints.json with image.png and, if there is one, mask.png
//   <stem>.joints.json with <stem>.png and, if there is one, <stem>.mask.png
//   a COCO file (.json with "images" and "annotations") with keypoints and polygons
//   <stem>.skeleton.json of one of the body plans and of its picture's first figure; not of pictures of which
//   others speak
// A COCO file that we have exported does not count for pictures of which others speak, or that have a label
// file: `passed_over`, if given, is told its name.
// Throws InputError: a file that is broken, two annotations of one picture, a picture that is missing or has
// changed since its skeleton was found. `on_error`, if given, is told what is wrong with one drawing alone,
// and the others are found.
std::vector<AnnotatedDrawing> findAnnotatedDrawings(const std::string& dir, const BodyPlans& plans,
                                                    const OnInputError& on_error = {},
                                                    std::set<std::string>* passed_over = nullptr);

// Whether a file holds COCO annotations. Throws InputError: a .json file that cannot be read.
bool isCoco(const std::string& path);

// The annotations of one COCO file. Pictures with several: the largest figure. `on_error`, if given, is told
// of pictures that are missing, and the others are read.
std::vector<AnnotatedDrawing> readCoco(const std::string& path, const BodyPlans& plans,
                                       const OnInputError& on_error = {});

// COCO keypoints that readCoco() reads back. `recognized` joints are no keypoints of the file (visibility 0):
// they stand in `skel_found`, which nobody else takes for truth. An outline that was found comes back as
// none.
struct CocoPicture {
  std::string file_name;
  int width = 0, height = 0;
  NamedJoints joints;
  std::vector<std::string> recognized;  // those of `joints` that no person has placed
  std::vector<Polygon> mask_polygons;
  bool outline_found = false;  // by the program: no person has given or mended a mask
};
// A category each body plan.
std::string formatCoco(const std::vector<CocoPicture>& pictures, const BodyPlans& plans);

// 255 at pixels whose centre lies inside. Places within 1e6 px of the first pixel. Even-odd: a polygon inside
// another is a hole.
Plane8 maskFromPolygons(const std::vector<Polygon>& polygons, int width, int height);

}  // namespace skel
