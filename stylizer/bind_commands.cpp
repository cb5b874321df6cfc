#include <CLI/CLI.hpp>

#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "stylizer/commands.h"

namespace skel {
namespace {

void bindFilm(CLI::App& app, FilmSource& source) {
  app.add_option("--fps", source.frame_rate, "Frames a second of a folder of pictures (a film says its own)")
      ->check(numberIn(0.1, 240.0))
      ->each([&source](const std::string&) { source.frame_rate_given = true; })
      ->capture_default_str();
  app.add_option(
         "--figure", source.figure,
         "How the figure is found: by the frames' alpha, before a still background, by its silhouette")
      ->check(CLI::IsMember({"auto", "alpha", "still", "silhouette"}))
      ->capture_default_str();
  app.add_option("--cutoff", source.foreground.cutoff,
                 "Of the low-pass that takes noise away, as a share of the highest frequency")
      ->check(numberIn(0.01, 1.0))
      ->capture_default_str();
}

void bindFilmPath(CLI::App& app, FilmSource& source) {
  app.add_option("film", source.path, "A film (.mp4, .gif, ...), or a folder of its frames")
      ->required()
      ->type_name("FILM");
  bindFilm(app, source);
}

void bindThreshold(CLI::App& app, double& threshold) {
  app.add_option(
         "--threshold", threshold,
         "A frame is a key frame if its outline differs from the one before by more than this share of "
         "the largest difference")
      ->check(numberIn(0.0, 1.0))
      ->capture_default_str();
}

void bindCoding(CLI::App& app, SparseCodingOptions& options) {
  app.add_option("-k,--components", options.components, "Parts that poses are made of")
      ->check(numberIn(1, 34))
      ->capture_default_str();
  app.add_option("--sparsity", options.sparsity,
                 "How few of them a pose should use: 0 for as many as it likes")
      ->check(numberIn(0.0, 1e6))
      ->capture_default_str();
  app.add_option("--iterations", options.max_iterations, "Of the factorisation, at most")
      ->check(numberIn(1, 1000000))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Of where the factorisation begins")
      ->check(seedNumber())
      ->capture_default_str();
}

void bindLoop(CLI::App& app, std::string& loop) {
  app.add_option("--loop", loop, "Whether the first frame follows the last; auto: if it looks so")
      ->check(CLI::IsMember({"auto", "yes", "no"}))
      ->capture_default_str();
}

void bindStyle(CLI::App& app, StyleRequest& request) {
  app.add_option("--amount", request.amount, "Of the style: 0 none, 1 all, more is more")
      ->check(numberIn(-4.0, 4.0))
      ->capture_default_str();
  app.add_option("--mirror", request.mirror,
                 "The style as in a mirror; auto: where the two look to different sides")
      ->check(CLI::IsMember({"auto", "yes", "no"}))
      ->capture_default_str();
  app.add_option("--match", request.match,
                 "How components are made to mean the same: both factored together, by phases, or each by "
                 "itself, by the signatures of action classes")
      ->check(CLI::IsMember({"phases", "signatures"}))
      ->capture_default_str();
  bindLoop(app, request.loop);
  bindCoding(app, request.coding);
}

void bindPerform(CLI::App& app, PerformRequest& request) {
  app.add_option(
         "--results", request.mended.results,
         "Where skel-infer -o DIR wrote the results of the drawing: what was mended there is taken up, "
         "before what lies beside the drawing and in out/")
      ->type_name("DIR");
  app.add_option("--order", request.order,
                 "The figure's parts, back to front: left_leg, right_leg, body, left_arm, right_arm, with "
                 "commas (default: as they are drawn)")
      ->type_name("PART,...");
  app.add_option("--background", request.background,
                 "keep (that of the drawing), white, grey, black, none (transparent), #rrggbb, or a picture")
      ->capture_default_str();
  app.add_option("--size", request.size_px, "Of the film's long side, px")
      ->check(numberIn(16, 4096))
      ->capture_default_str();
  app.add_option("--rate", request.frame_rate, "Frames a second of the film (default: the motion's)")
      ->check(numberIn(0.1, 240.0));
  app.add_option("--duration", request.duration_s, "In seconds; the motion repeats (default: once)")
      ->check(numberIn(0.0, 3600.0));
  app.add_flag("--in-place", request.in_place, "The figure stays where it is, but for ups and downs");
}

}  // namespace

void bindKeyframes(CLI::App& app, KeyframesOptions& options) {
  bindFilmPath(app, options.film);
  app.add_option("-o,--output", options.output, "A folder for keyframes.json and pictures")
      ->type_name("DIR")
      ->capture_default_str();
  bindThreshold(app, options.threshold);
  app.add_flag("--matrix", options.matrix, "All distances between frames (4000 at most), also as a picture");
}

void bindKeypoints(CLI::App& app, KeypointsCommandOptions& options) {
  bindFilmPath(app, options.find.film);
  app.add_option("-o,--output", options.find.output, "The motion file (default: out/<film>.motion.json)")
      ->type_name("FILE")
      ->check(outputFile("skel-motion"));
  app.add_option("--action", options.find.action, "Its class: walk, run, jump, ...");
  bindThreshold(app, options.find.threshold);
  bindLoop(app, options.find.loop);
  app.add_option("--smooth", options.find.track.smoothness,
                 "How much key points are smoothed over time; 0: not")
      ->check(numberIn(0.0, 1000.0))
      ->capture_default_str();
  app.add_flag("--force", options.force, "Also over joints that were placed by hand");
}

void bindDatabase(CLI::App& app, DatabaseOptions& options) {
  app.add_option("task", options.task, "add, list or check")
      ->required()
      ->check(CLI::IsMember({"add", "list", "check"}));
  app.add_option("folder", options.folder, "The database")->required()->type_name("DIR");
  app.add_option("motions", options.motions, "Motion files to add")->type_name("MOTION...");
  app.add_option("--action", options.action, "The class of what is added (default: what the file says)");
  app.add_flag("--force", options.force, "Replace motions of the same name");
}

void bindFit(CLI::App& app, FitOptions& options) {
  app.add_option("motions", options.motions, "Motion files, or databases")
      ->required()
      ->type_name("MOTION...");
  app.add_option("-o,--output", options.output, "The .style.json")
      ->type_name("FILE")
      ->capture_default_str()
      ->check(outputFile("skel-style"));
  bindCoding(app, options.coding);
  app.add_option("--ridge", options.semantic.ridge, "Of the semantic term")
      ->check(numberIn(1e-12, 1e6))
      ->capture_default_str();
  app.add_flag("--all-frames", options.all_frames, "Not the key frames alone");
}

void bindTransfer(CLI::App& app, TransferCommandOptions& options) {
  app.add_option("--content", options.content, "Who moves: a motion file, or a database")->required();
  app.add_option("--style", options.style, "How: a motion file, or a database")->required();
  app.add_option("-o,--output", options.output, "The motion file to write")
      ->type_name("FILE")
      ->capture_default_str()
      ->check(outputFile("skel-motion"));
  app.add_flag("--force", options.force, "Also over joints that were placed by hand");
  bindStyle(app, options.request);
}

void bindRender(CLI::App& app, RenderOptions2D& options) {
  app.add_option("--character", options.character, "A drawing, its .skeleton.json, or a .glb made of one")
      ->type_name("FILE");
  app.add_option("--motion", options.motion, "A motion file")->required()->type_name("FILE");
  app.add_option("-o,--output", options.output,
                 "The film: " + videoFormatNames() + " (a name that ends with /) of PNG files")
      ->type_name("FILE")
      ->check(outputFile());
  app.add_option("--to-clip", options.to_clip, "A .clip.json for 3D characters, to be played by skel-animate")
      ->type_name("FILE")
      ->check(outputFile("skel-clip"));
  bindLoop(app, options.loop);
  bindPerform(app, options.perform);
  app.add_flag("--force", options.perform.mended.force, "Leave out what was mended by hand of the drawing");
}

void bindInspect(CLI::App& app, InspectOptions& options) {
  app.add_option("motion", options.motion, "A motion file")->required()->type_name("MOTION");
  app.add_option("-o,--output", options.output, "The picture (.png)")
      ->type_name("FILE")
      ->capture_default_str()
      ->check(outputFile());
  bindCoding(app, options.coding);
}

void bindMake(CLI::App& app, MakeOptions& options) {
  app.add_option("--character", options.character, "A drawing, its .skeleton.json, or a .glb made of one")
      ->required()
      ->type_name("FILE");
  app.add_option("--content", options.content, "What it does: a film, a folder of frames, or a .motion.json")
      ->required();
  app.add_option("--style", options.style, "How: a film, a folder of frames, or a .motion.json")->required();
  app.add_option("-o,--output", options.output, "The film: " + videoFormatNames())
      ->type_name("FILE")
      ->capture_default_str()
      ->check(outputFile());
  app.add_option("--work", options.work,
                 "A folder for what lies between; what is there already of these films is taken (default: "
                 "<output>.work)")
      ->type_name("DIR");
  app.add_flag("--force", options.force,
               "Make everything anew, also over joints placed by hand, of the films and of the drawing");
  bindFilm(app, options.film);
  bindStyle(app, options.request);
  bindPerform(app, options.perform);
}

}  // namespace skel
