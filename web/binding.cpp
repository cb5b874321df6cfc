// The core for JavaScript: bytes in, bytes out. What is read and written are the files of skel-infer, so that
// a character can go on there and come back.
#include <emscripten/bind.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <string>

#include "libskel/core/caught_error.h"
#include "libskel/core/error.h"
#include "libskel/core/sha256.h"
#include "libskel/cutout/cut_out_atlas.h"
#include "libskel/image/check_image.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/pipeline/drawn_cut_out.h"
#include "libskel/pipeline/rig_document.h"
#include "libskel/pipeline/rig_drawing.h"
#include "libskel/silhouette/page_net.h"
#include "libskel/skeleton/outside_figure.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {
namespace {
using emscripten::val;

// Fills `bytes` with `array`.
template <class Bytes>
void copyInto(Bytes& bytes, const val& array) {
  val(emscripten::typed_memory_view(static_cast<std::size_t>(bytes.size()),
                                    reinterpret_cast<std::uint8_t*>(bytes.data())))
      .call<void>("set", array);
}

std::string bytesOf(const val& array) {
  std::string bytes(array["length"].as<std::size_t>(), '\0');
  copyInto(bytes, array);
  return bytes;
}

// A copy that JavaScript owns; `type` is its name there.
template <class Number>
val numbersOf(const char* type, const Number* numbers, std::size_t count) {
  return val::global(type).new_(val(emscripten::typed_memory_view(count, numbers)));
}

template <class Bytes>
val arrayOf(const Bytes& bytes) {
  return numbersOf("Uint8Array", reinterpret_cast<const std::uint8_t*>(bytes.data()),
                   static_cast<std::size_t>(bytes.size()));
}

val textsOf(const std::vector<std::string>& texts) {
  val array = val::array();
  for (const std::string& text : texts) array.call<void>("push", text);
  return array;
}

std::string stemOf(const std::string& file) {
  const std::size_t dot = file.rfind('.');
  return dot == std::string::npos || dot == 0 ? file : file.substr(0, dot);
}

// Throws unless `array` holds just what a picture of that size needs: the memory that a shorter one would
// leave as it is has held the pictures of others. `what` it is stands in the complaint.
void checkLength(const val& array, int width, int height, int bytes_a_pixel, const std::string& file,
                 const std::string& what) {
  const auto has = array["length"].as<double>();
  const double needs = static_cast<double>(width) * height * bytes_a_pixel;
  if (has == needs) return;
  const std::string hint =
      bytes_a_pixel == 4 && has * 4 == needs * 3 ? "; RGB needs a fourth byte a pixel, alpha" : "";
  throw InputError(file, what + " has " + std::to_string(static_cast<std::int64_t>(has)) + " bytes, " +
                             sizeInPx(width, height) + " px of " + std::to_string(bytes_a_pixel) +
                             (bytes_a_pixel == 1 ? " byte" : " bytes") + " need " +
                             std::to_string(static_cast<std::int64_t>(needs)) + hint);
}

Image imageOf(const val& rgba, int width, int height, const std::string& file) {
  if (width < 1 || height < 1) throw InputError(file, "has no pixels: " + sizeInPx(width, height));
  if (std::max(width, height) > kLongestSide_px || std::int64_t{width} * height > kMaxPixels)
    throw InputError(file, "is too large: " + sizeInPx(width, height) + " px; make it smaller");
  checkLength(rgba, width, height, 4, file, "rgba");
  Image image(width, height);
  copyInto(image.rgba, rgba);
  return image;
}

Plane8 planeOf(const val& mask, int width, int height, const std::string& file) {
  checkLength(mask, width, height, 1, file, "mask");
  Plane8 plane(height, width);
  copyInto(plane, mask);
  return plane;
}

// What the tools would have said, as {error}.
template <class Work>
val saying(const std::string& file, const Work& work) {
  std::string message;
  try {
    return work();
  } catch (...) {
    message = caughtError(file).what();
  }
  val said = val::object();
  said.set("error", message);
  return said;
}

// The nets at work, which are handed over once.
struct Nets {
  std::vector<std::string> files;
  std::shared_ptr<const JointNets> joints;
  std::shared_ptr<const PageNet> page;
  std::shared_ptr<const PartNet> parts;
};
Nets nets;

// The character at work.
struct Character {
  std::shared_ptr<const RiggedDrawing> drawing = std::make_shared<RiggedDrawing>();
  SkeletonFile file;
  Plane8 given_mask;  // empty: none was given
  std::string stem;
  std::optional<CutOut> cut_out;  // of the drawing, made when it is asked for
};
Character current;
RigDocument document;  // what it was rigged from

// `body_plan`: "": the one that the figure fits.
RigOptions optionsFor(const std::string& body_plan, int figure, bool upright) {
  RigOptions options = rigOptions(body_plan.empty() ? "auto" : body_plan);
  options.upright = upright;
  options.joint_nets = nets.joints;
  options.silhouette.page_net = nets.page;
  options.part_net = nets.parts;
  options.silhouette.figure = figure;
  return options;
}

SkeletonFile skeletonFileOf(const std::string& text, const std::string& name) {
  const std::string plan = templateOfSkeleton(text, name);
  const auto known = builtinTemplates();
  if (std::find(known.begin(), known.end(), plan) == known.end())
    throw InputError(name, "template: \"" + plan + "\" is no body plan that is known here");
  return parseSkeletonFile(text, name, loadTemplate(plan));
}

SkeletonFile givenSkeleton(const std::string& text, const std::string& name, const std::string& image,
                           const RigInput& input) {
  SkeletonFile given = skeletonFileOf(text, name);
  if (given.image_width != input.image.width || given.image_height != input.image.height)
    throw InputError(name, "belongs to an image of " + sizeInPx(given.image_width, given.image_height) +
                               " px, " + image + " has " + sizeInPx(input.image.width, input.image.height));
  return given;
}

void checkJoints(const SkeletonFile& given, const std::string& name, const Plane8& mask) {
  if (const Joint* stray = jointFarOutside(given.skeleton, mask))
    throw InputError(name, "joint \"" + stray->name + "\" lies far outside figure " +
                               std::to_string(given.figure.number) +
                               " of the drawing; place it on the figure, or take the skeleton of this one");
}

val described() {
  val said = val::object();
  val times = val::object();
  for (const StageTime& time : current.drawing->times) times.set(time.stage, time.time_s * 1e3);
  const Skeleton& skeleton = current.drawing->recognition.skeleton;
  said.set("skeleton", formatSkeletonFile(current.file));
  said.set("plan", skeleton.template_name);
  said.set("confidence", current.file.confidence);
  said.set("warnings", textsOf(current.file.warnings));
  said.set("figures", current.drawing->silhouette.figure_count);
  said.set("mask", arrayOf(current.drawing->silhouette.mask));
  said.set("times", times);
  return said;
}

// Request: the bytes of {page, parts: of the nets so called, biped, quadruped: of the joint nets}. Returns {}
// or {error}.
val useNets(const val& request) {
  return saying("the nets", [&] {
    Nets given;
    for (const char* name : {"page", "parts", "biped", "quadruped"})
      given.files.push_back(bytesOf(request[name]));
    given.page = std::make_shared<const PageNet>(readyToRun(parsePageNet(given.files[0], "page net")));
    given.parts = std::make_shared<const PartNet>(readyToRun(parsePartNet(given.files[1], "part net")));
    given.joints = std::make_shared<const JointNets>(
        std::vector<JointNets::File>{{"biped", given.files[2], "joint net of the biped"},
                                     {"quadruped", given.files[3], "joint net of the quadruped"}});
    for (const std::string_view plan : given.joints->bodyPlans()) given.joints->of(plan);  // broken: said now
    nets = std::move(given);
    document = RigDocument();
    return val::object();
  });
}

// {width, height, rgba} of a PNG file, or {error}: what other pictures hold, the browser knows.
val decode(const val& bytes, const std::string& file) {
  return saying(file, [&] {
    const Image image = decodeImage(bytesOf(bytes), file);
    val said = val::object();
    said.set("width", image.width);
    said.set("height", image.height);
    said.set("rgba", arrayOf(image.rgba));
    return said;
  });
}

// A mask as small as its drawing was made: on the figure is what is so by half at least.
Plane8 madeSmaller(const Plane8& mask, int width, int height) {
  const auto from = [](int i, Eigen::Index size, int count) { return i * std::int64_t{size} / count; };
  Plane8 small(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto top = from(y, mask.rows(), height), left = from(x, mask.cols(), width);
      const auto cell = mask.block(top, left, from(y + 1, mask.rows(), height) - top,
                                   from(x + 1, mask.cols(), width) - left);
      small(y, x) = 2 * (cell > 0).count() >= cell.size() ? 255 : 0;
    }
  }
  return small;
}

// Request: {bytes, file, width, height, ofWidth, ofHeight, skeleton, skeletonFile}, of a PNG file that
// belongs to a picture of that size, which was made of one of that other size or is it, and, unless
// `skeleton` is null, to the text of that skeleton file. A mask of either size is taken. Returns {mask:
// width·height bytes, 255 on the figure} or {error}.
val maskOf(const val& request) {
  const auto file = request["file"].as<std::string>();
  return saying(file, [&] {
    const std::string bytes = bytesOf(request["bytes"]);
    Plane8 mask = decodeMask(bytes, file);
    const int width = request["width"].as<int>(), height = request["height"].as<int>();
    const int of_width = request["ofWidth"].as<int>(), of_height = request["ofHeight"].as<int>();
    if (mask.cols() != width || mask.rows() != height) {
      if (mask.cols() != of_width || mask.rows() != of_height)
        throw InputError(file, "is a mask of " + sizeInPx(mask.cols(), mask.rows()) + " px, the image has " +
                                   sizeInPx(of_width, of_height));
      mask = madeSmaller(mask, width, height);
    }
    if (!request["skeleton"].isNull()) {
      const auto name = request["skeletonFile"].as<std::string>();
      const SkeletonFile given = skeletonFileOf(request["skeleton"].as<std::string>(), name);
      if (given.mask && given.mask->sha256 != sha256(bytes))
        throw InputError(
            file, "has changed since " + name + " was made with it; drop it without that if it is meant");
    }
    val said = val::object();
    said.set("mask", arrayOf(mask));
    return said;
  });
}

// Request: {file, width, height, rgba, mask, skeleton, skeletonFile, plan, figure, upright, draft}. `rgba`
// (width·height·4 bytes) and `mask` are refused if they are shorter or longer than that. `mask` (width·height
// bytes, 255 on the figure) and `skeleton` (the text of a skeleton file) may be null, `plan` empty: the one
// that fits; `upright`: the figure is not turned. What is as it was in the last call is not made anew. With
// `draft`, joints that have moved since then move in the model that is there, for the eye
// (RigDocument::draft()). Returns {skeleton, plan, confidence, warnings, figures, mask, times in ms} or
// {error}.
val rig(const val& request) {
  const auto file = request["file"].as<std::string>();
  return saying(file, [&] {
    RigInput input;
    const int width = request["width"].as<int>(), height = request["height"].as<int>();
    input.image = imageOf(request["rgba"], width, height, file);
    Character made;
    made.stem = stemOf(file);
    if (!request["mask"].isNull()) {
      Plane8 mask = planeOf(request["mask"], width, height, file);
      made.file.mask = SkeletonFile::Mask{made.stem + ".mask.png", sha256(encodePng(mask))};
      input.mask = made.given_mask = std::move(mask);
    }
    int figure = request["figure"].as<int>();
    if (figure < 1) throw InputError(file, "figure: must be 1 or more");
    std::optional<SkeletonFile> given;
    std::string skeleton_file;
    if (!request["skeleton"].isNull()) {
      skeleton_file = request["skeletonFile"].as<std::string>();
      given = givenSkeleton(request["skeleton"].as<std::string>(), skeleton_file, file, input);
      input.skeleton = given->skeleton;
      input.turned_deg = given->figure.turned_deg;
      figure = given->figure.number;
    }
    // A skeleton says itself of which body plan it is.
    const bool upright = request["upright"].as<bool>();
    RigOptions options = optionsFor(given ? "" : request["plan"].as<std::string>(), figure, upright);
    if (given && planNamed(given->skeleton.template_name, options).name != given->skeleton.template_name)
      options = optionsFor(given->skeleton.template_name, figure, upright);
    document.setOptions(std::move(options));
    document.setInput(std::move(input));
    made.drawing = request["draft"].as<bool>() ? document.draft() : document.rigged();
    const RiggedDrawing& drawing = *made.drawing;
    if (!drawing.found()) throw InputError(file, drawing.silhouette.reason);
    made.file.warnings = drawing.silhouette.warnings;
    if (given) {
      checkJoints(*given, skeleton_file, drawing.silhouette.mask);
      made.file.confidence = given->confidence;
      made.file.missing = given->missing;
      // What was said of joints before somebody moved them is stale.
      const auto& joints = given->skeleton.joints;
      if (std::none_of(joints.begin(), joints.end(),
                       [](const Joint& joint) { return joint.origin == JointOrigin::kEdited; }))
        for (const std::string& warning : given->warnings)
          if (std::find(made.file.warnings.begin(), made.file.warnings.end(), warning) ==
              made.file.warnings.end())
            made.file.warnings.push_back(warning);
      if (!document.input().mask && !given->figure.sha256.empty() &&
          given->figure.sha256 != outlineHash(drawing.silhouette))
        made.file.warnings.push_back(
            "the figure is not outlined as it was when the joints were found: look at them");
    } else {
      made.file.confidence = drawing.recognition.confidence;
      made.file.missing = drawing.recognition.missing;
      made.file.warnings.insert(made.file.warnings.end(), drawing.recognition.warnings.begin(),
                                drawing.recognition.warnings.end());
    }
    made.file.image_file = file;
    made.file.image_width = width;
    made.file.image_height = height;
    made.file.figure = {figure, outlineHash(drawing.silhouette), drawing.recognition.turned_deg};
    made.file.skeleton = drawing.recognition.skeleton;
    current = std::move(made);
    return described();
  });
}

// The .glb of the character at work.
val glb() {
  return arrayOf(encodeGlb(current.drawing->character, current.drawing->clips, {.name = current.stem}));
}

const CutOut& currentCutOut() {
  if (!current.cut_out) current.cut_out = cutOutOf(*current.drawing);
  return *current.cut_out;
}

// The drawing as a cut-out (cut_out_atlas.h): {width, height, rgba, its colours multiplied by alpha,
// texcoords: two a corner, vertex: one a corner, triangles: three corners each, in the order in which they
// are painted}.
val flat() {
  return saying(current.stem, [&] {
    const CutOutAtlas atlas = atlasOf(currentCutOut());
    const Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor> texcoords = atlas.texcoords;
    val said = val::object();
    said.set("width", atlas.picture.width);
    said.set("height", atlas.picture.height);
    said.set("rgba", arrayOf(atlas.picture.rgba));
    said.set("texcoords", numbersOf("Float32Array", texcoords.data(), std::size_t(texcoords.size())));
    said.set("vertex", numbersOf("Uint32Array", atlas.vertex.data(), atlas.vertex.size()));
    said.set("triangles", numbersOf("Uint32Array", atlas.triangles.data(), atlas.triangles.size()));
    return said;
  });
}

// Its places in a clip, or in the pose that it was drawn in if there is none of that name, at `rate_hz`
// moments a second: {frames, duration in s, places: x and y of each vertex, m, frame by frame}.
val flatClip(const std::string& name, double rate_hz) {
  return saying(current.stem, [&] {
    const std::vector<Clip>& clips = current.drawing->clips;
    const auto clip = std::find_if(clips.begin(), clips.end(), [&](const Clip& c) { return c.name == name; });
    const Clip chosen = clip == clips.end() ? Clip() : *clip;
    const double duration_s = double(chosen.duration_s());
    const int frames = std::max(1, int(std::lround(duration_s * rate_hz)));
    const CutOut& cut_out = currentCutOut();
    const Calm calm = clip == clips.end() ? Calm() : calmFor(*current.drawing, cut_out, chosen);
    std::vector<float> places;
    for (int i = 0; i < frames; ++i)
      for (const Eigen::MatrixX2d& sheet :
           posedSheets(cut_out, flatPoseAt(*current.drawing, chosen, duration_s * i / frames, calm)))
        for (Eigen::Index v = 0; v < sheet.rows(); ++v)
          places.insert(places.end(), {float(sheet(v, 0)), float(sheet(v, 1))});
    val said = val::object();
    said.set("frames", frames);
    said.set("duration", duration_s);
    said.set("places", numbersOf("Float32Array", places.data(), places.size()));
    return said;
  });
}

// Its texture, as PNG.
val texture() { return arrayOf(encodePng(current.drawing->character.mesh.texture)); }

// Its drawing and its mask, as PNG.
val drawing() { return arrayOf(encodePng(current.drawing->image)); }
val mask() {
  const Plane8& given = current.given_mask;
  return arrayOf(encodePng(given.size() > 0 ? given : current.drawing->silhouette.mask));
}

}  // namespace
}  // namespace skel

EMSCRIPTEN_BINDINGS(skel) {
  emscripten::function("useNets", &skel::useNets);
  emscripten::function("decode", &skel::decode);
  emscripten::function("readMask", &skel::maskOf);
  emscripten::function("rig", &skel::rig);
  emscripten::function("glb", &skel::glb);
  emscripten::function("flat", &skel::flat);
  emscripten::function("flatClip", &skel::flatClip);
  emscripten::function("texture", &skel::texture);
  emscripten::function("drawing", &skel::drawing);
  emscripten::function("mask", &skel::mask);
}
