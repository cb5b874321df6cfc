#include "stylizer/performer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/draw/render_mesh.h"
#include "libskel/image/read_image.h"
#include "libskel/import/read_character.h"
#include "libskel/mended/mend_places.h"
#include "libskel/mended/rig_mended.h"
#include "libskel/pipeline/drawing_notes.h"
#include "libskel/pipeline/rig_drawing.h"
#include "libskel/skeleton/hanging.h"

namespace skel {
namespace {

constexpr int kFront_px = 1024;  // the long side of a model's front view

Performer seenFromTheFront(const std::string& path) {
  const RiggedCharacter character = readGlb(path).character;
  if (character.skeleton.template_name != "biped")
    throw InputError(path, "has other joints than skel's biped; make it by skel-infer, with --names skel");
  const TriangleMesh& mesh = character.mesh;
  const Eigen::Vector2f size =
      (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).head<2>();
  if (!(size.minCoeff() > 0)) throw InputError(path, "is flat as seen from the front");
  const auto px = [&](float side) {
    return std::max(1, int(std::lround(double(kFront_px) * double(side / size.maxCoeff()))));
  };
  RenderOptions options;
  options.width = px(size.x());
  options.height = px(size.y());
  if (!mesh.texture.empty()) options.shading = 0;
  options.ink = false;
  const Camera camera = framingCamera(mesh.vertices, 0, 0, double(options.width) / options.height);
  Performer performer;
  performer.image = renderMesh(mesh.vertices, mesh, camera, options);
  performer.silhouette = extractSilhouette(performer.image);
  performer.body_plan = loadTemplate("biped");
  performer.skeleton = withoutHanging(character.skeleton);
  performer.model_from_image.scale.setConstant(double(size.y()) / options.height);
  if (!performer.silhouette.found()) throw InputError(path, performer.silhouette.reason);
  const Projection project(camera, options.width, options.height);
  for (Joint& joint : performer.skeleton.joints) {
    const auto at = project(joint.position);
    if (!at) throw InputError(path, "has its joint \"" + joint.name + "\" far before the model");
    joint.image = *at;
    joint.tail.reset();
    joint.position.head<2>() = performer.model_from_image(*at);
  }
  performer.layers = inOnePiece(findLayers(performer.image, performer.silhouette, performer.skeleton,
                                           performer.body_plan, builtInPartNet()),
                                performer.body_plan);
  return performer;
}

struct Rigged {
  RiggedDrawing drawing;
  std::vector<std::string> warnings;
  std::vector<Note> notes;
};

Rigged rigPerformer(const std::string& path, const MendedSource& mended) {
  RigOptions options = rigOptionsWithoutClips("auto");
  options.last = LastStage::kModel;
  if (path.ends_with(kSkeletonFileEnding)) {
    RiggedDrawing drawing = rigDrawing(path, options);
    std::vector<std::string> warnings = figureNotes(drawing);
    return {std::move(drawing), std::move(warnings), {}};
  }
  const std::string bytes = readFile(path);
  MendRequest request;
  request.source = path;
  request.image_sha256 = sha256(bytes);
  request.results = resultsIn(mended.results, path, request.figure);
  request.out_dir = mended.results;
  request.takes_up = !mended.force;
  RigInput input;
  input.image = decodeImage(bytes, path);
  MendedRig rig = rigMended(request, options, std::move(input), {});
  std::vector<Note> notes = mendedNotes(rig, request, options);
  return {std::move(rig.drawing), std::move(rig.warnings), std::move(notes)};
}

}  // namespace

Performer readPerformer(const std::string& path, const MendedSource& mended) {
  if (!mended.results.empty() && (path.ends_with(".glb") || path.ends_with(kSkeletonFileEnding)))
    throw UsageError("--results is of a drawing, whose mended joints are looked for there; " + path +
                     " has its own: leave --results out");
  if (path.ends_with(".glb")) return seenFromTheFront(path);
  Rigged rigged = rigPerformer(path, mended);
  RiggedDrawing& drawing = rigged.drawing;
  if (drawing.body_plan.name != "biped")
    throw InputError(path,
                     "is a " + drawing.body_plan.name +
                         "'s figure, and these motions are a person's; if it is a person, give its joints "
                         "instead: the .skeleton.json that skel-infer --template biped writes");
  Performer performer;
  performer.notes = withAdviceIfUpright(std::move(rigged.warnings),
                                        "give the .skeleton.json that skel-infer --upright writes");
  for (const Note& note : rigged.notes) performer.notes.push_back(noteText(note, path));
  for (const Note& note : limbNotes(drawing, {})) performer.notes.push_back(noteText(note, path));
  performer.model_from_image = drawing.character.mesh.model_from_image;
  performer.skeleton = withoutHanging(drawing.character.skeleton);
  performer.image = drawing.colors();
  performer.silhouette = std::move(drawing.silhouette);
  performer.body_plan = std::move(drawing.body_plan);
  performer.layers = std::move(drawing.layers);
  return performer;
}

}  // namespace skel
