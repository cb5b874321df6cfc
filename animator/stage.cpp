#include "animator/stage.h"

#include <cstdio>
#include <numbers>

#include "libskel/core/error.h"
#include "libskel/core/text.h"

namespace skel {

Stage::Stage(const RenderCommandOptions& options, const Performer& performer)
    : options_(options), performer_(performer) {
  const RiggedCharacter& character = performer.file.character;
  if (!options.weights_of.empty()) {
    weights_of_ = character.skeleton.find(options.weights_of);
    if (weights_of_ < 0)
      throw UsageError("--show-weights: there is no joint \"" + options.weights_of + "\" in " +
                       performer.file.name);
  }
  if (options.frame == "clips" || (options.frame == "auto" && manyClips(options))) {
    ClipSource library = options.library;
    library.flat = performer.flat.has_value();
    CharacterFile with_library = performer.file;
    addLibrary(with_library, library);
    shown_ = std::move(with_library.clips);
    shown_.insert(shown_.end(), performer.clips.begin(), performer.clips.end());
  }
  if (performer.flat)
    flat_ = std::make_unique<FlatFigure>(*performer.flat);
  else
    scene_ = std::make_unique<Scene>(character, painterFor(options, character.mesh));
}

MomentPainter Stage::painterOf(const Clip& clip, const FilmOptions& film) const {
  const std::vector<Clip> shown = shown_.empty() ? std::vector<Clip>{clip} : shown_;
  const double width_over_height = double(film.width) / film.height;
  if (flat_) {
    const Camera camera = flat_->camera(shown, width_over_height);
    const auto painter = std::make_shared<CutOutPainter>(flat_->painterFor(camera, film.height));
    const Calm calm = flat_->calmFor(clip);
    return [this, clip, calm, film, camera, painter](double time_s) {
      return flat_->paint(clip, calm, time_s, camera, *painter, film);
    };
  }
  const RiggedCharacter& character = performer_.file.character;
  const Camera camera =
      filmCamera(character, shown, options_.angles(performer_.file.name) * std::numbers::pi / 180,
                 options_.pitch_deg * std::numbers::pi / 180, width_over_height);
  Look look = film.look;
  look.weights_of = weights_of_;
  return [this, clip, film, camera, look](double time_s) {
    return scene_->paint(posedAt(scene_->character(), clip, time_s), camera, film.width, film.height, look);
  };
}

bool Stage::sayTorn(const Clip& clip) const {
  const Calm calm = flat_ ? flat_->calmFor(clip) : Calm();
  if (calm.torn <= kMuchTorn) {
    if (calm.legs < 1)
      std::fprintf(stderr,
                   "%s: note: \"%s\" moves the legs %sless than it would, which would tear the drawing\n",
                   printable(performer_.file.name).c_str(), printable(clip.name).c_str(),
                   calm.rest < 1 ? "and the rest " : "");
    return false;
  }
  std::fprintf(stderr,
               "%s: note: \"%s\" tears up to %.1f %% of the drawing: look at the film, or take --look "
               "solid\n",
               printable(performer_.file.name).c_str(), printable(clip.name).c_str(), 100 * calm.torn);
  return true;
}

}  // namespace skel
