#include "animator/render_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "animator/film.h"
#include "animator/in_place.h"
#include "animator/pixel_look.h"
#include "animator/sprite_atlas.h"
#include "animator/sprite_camera.h"
#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/core/text.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/read_image.h"
#include "libskel/image/sprite_sheet_file.h"
#include "libskel/image/write_image.h"
#include "libskel/pipeline/facing.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

std::string degreesText(double angle_deg) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%g", angle_deg);
  return text.data();
}

struct Sheets {
  const RenderCommandOptions& options;
  std::optional<SpriteCell> like;  // of --like
  PictureSize size;
  bool in_folder;
  // Of --same-scale: what each character reaches.
  struct Measured {
    std::string name;
    SpriteExtent extent;
  };
  std::vector<Measured> measured = {};
  bool who_is_told = false, other_is_kept = false;
  int most_colors = 0;         // 0: as many as there are
  std::vector<Color> palette;  // the colours, where they are known

  explicit Sheets(const RenderCommandOptions& asked)
      : options(asked),
        like(cellLike(asked)),
        size(like ? PictureSize{like->width, like->height} : sizeOf(asked, {64, 64})),
        in_folder(asked.sheet.output.ends_with('/')) {
    if (options.sheet.same_scale && options.files.size() == 1)
      std::fprintf(stderr,
                   "skel-animate: note: --same-scale does nothing for one drawing; --like SHEET.json takes "
                   "the scale of a sheet that is there\n");
    const std::string& path = options.sheet.output;
    if (!in_folder && fs::path(path).extension() != ".png" && fs::path(path).extension() != ".PNG")
      throw UsageError(path + ": a sprite sheet is a .png, or a folder (a name that ends with /) of such");
    if (!in_folder && options.files.size() > 1)
      throw UsageError(path + " must be a folder (a name that ends with /): there are several drawings");
    checkSheetSize({}, {size.width, size.height}, SpritePacking::kEven);
    if (isCount(options.sheet.palette)) {
      most_colors = std::stoi(options.sheet.palette);
    } else if (!options.sheet.palette.empty()) {
      const LookAtOutputs it_may_be_made_again;
      palette = paletteOf(readImage(options.sheet.palette), options.sheet.palette);
    }
    if (!in_folder) noteSheet(path);
    ensureWritableFolderOf(path);
  }

  // Throws UsageError where something else is asked for than that sheet has.
  static std::optional<SpriteCell> cellLike(const RenderCommandOptions& asked) {
    const std::string& path = asked.sheet.like;
    if (path.empty()) return std::nullopt;
    const LookAtOutputs it_may_be_made_again;
    const SpriteCell cell = readSpriteCell(path);
    const PictureSize size = sizeOf(asked, {cell.width, cell.height});
    const auto refuse = [&](const char* option, const std::string& wanted, const std::string& there) {
      throw UsageError(std::string(option) + " is " + wanted + ", in " + path + " it is " + there +
                       ": leave --like out, or ask for " + option + " " + there);
    };
    if (size.width != cell.width || size.height != cell.height)
      refuse("--size", asked.size, std::to_string(cell.width) + "x" + std::to_string(cell.height));
    if (asked.pitch_deg != cell.pitch_deg)
      refuse("--pitch", degreesText(asked.pitch_deg), degreesText(cell.pitch_deg));
    return cell;
  }

  static std::string atlasOf(const std::string& sheet) {
    return fs::path(sheet).replace_extension(".json").string();
  }

  // A picture without frames beside it is no sheet, but somebody's drawing.
  static void noteSheet(const std::string& path) {
    std::error_code unknown;
    const std::string atlas = atlasOf(path);
    if (fs::is_regular_file(path, unknown) && !fs::exists(atlas, unknown))
      throw UsageError("--sheet would write over " + path + ", which is no sheet (there is no " +
                       fs::path(atlas).filename().string() + " beside it): name another file");
    if (fs::is_regular_file(atlas, unknown) && !isAtlas(atlas))
      throw UsageError("--sheet would write over " + atlas + ", which is no sheet's: name another file");
    noteNamedOutput(atlas);
  }

  std::string pathOf(const CharacterFile& file) const {
    if (!in_folder) return options.sheet.output;
    const std::string path = options.sheet.output + safeFileName(file.name) + ".png";
    noteNamedOutput(path);
    noteSheet(path);
    return path;
  }

  // How far sprites are painted larger than they become.
  int factor() const { return options.sheet.pixels ? 4 : 2; }

  Image paint(const Scene& scene, const Clip& clip, double time_s, const Camera& camera) const {
    Look look;
    look.background = kClear;
    look.shadow = false;
    look.ink = !options.no_ink;
    const Image large = scene.paint(posedAt(scene.character(), clip, time_s), camera, factor() * size.width,
                                    factor() * size.height, look);
    return options.sheet.pixels ? pixelated(large, factor()) : resized(large, size.width, size.height);
  }

  int frameCount(const Clip& clip) const {
    const int count = int(std::lround(double(clip.duration_s()) * options.frame_rate.value_or(12)));
    const int most = options.sheet.most_frames;
    return std::max(1, most > 0 ? std::min(count, most) : count);
  }

  // Clip by clip, direction by direction. Throws UsageError where a sheet has no place for them.
  std::vector<SpriteTag> tagsOf(const std::vector<Clip>& clips,
                                const std::vector<SpriteDirection>& directions, const SpriteCell& cell,
                                SpritePacking packing) const {
    std::vector<SpriteTag> tags;
    int first = 0;
    for (const Clip& clip : clips) {
      const int count = frameCount(clip);
      for (const SpriteDirection& direction : directions) {
        if (first > kMostSprites) break;
        tags.push_back({direction.name.empty() ? clip.name : clip.name + "-" + direction.name, first,
                        first + count - 1, clip.loops});
        first += count;
      }
    }
    checkSheetSize(tags, cell, packing);
    return tags;
  }

  double pitch_rad() const { return options.pitch_deg * std::numbers::pi / 180; }

  std::vector<SpriteDirection> directionsOf(const CharacterFile& file) const {
    std::vector<SpriteDirection> directions = spriteDirections(file.character, options.sheet.directions);
    for (SpriteDirection& direction : directions)
      direction.yaw_rad += options.angles(file.name) * std::numbers::pi / 180;
    return directions;
  }

  // Of all clips that the scale is for.
  SpriteExtent extentOf(CharacterFile file, std::vector<Clip> framed) const {
    if (options.frame == "clips") {
      addLibrary(file, options.library);
      for (const Clip& clip : file.clips) framed.push_back(inPlace(clip, file.character).clip);
    }
    const SpriteExtent extent = spriteExtent(file.character, outermostPoints(file.character, framed),
                                             directionsOf(file), pitch_rad());
    return extent.grown(options.no_ink ? 0 : double(file.character.mesh.ink.width_m));
  }

  void measure(const CharacterFile& file, const std::vector<Clip>& asked) {
    std::vector<Clip> clips;
    for (const Clip& clip : asked) clips.push_back(inPlace(clip, file.character).clip);
    measured.push_back({file.name, extentOf(file, std::move(clips))});
  }

  SpriteCamera cameraFor(const SpriteExtent& extent) const {
    return spriteCamera(extent, options.pitch_deg, size.width, size.height, options.sheet.outline ? 2 : 1);
  }

  SpriteExtent sharedExtent(std::size_t without = std::string::npos) const {
    SpriteExtent extent;
    for (std::size_t i = 0; i < measured.size(); ++i)
      if (i != without) extent = extent.with(measured[i].extent);
    return extent;
  }

  // One character that makes the sheets of several others much smaller.
  void tellWhoSetsScale(double px_per_m) const {
    constexpr double kMuch = 1.05;
    double most = 0;
    std::string name;
    for (std::size_t i = 0; measured.size() > 2 && i < measured.size(); ++i)
      if (const double without = cameraFor(sharedExtent(i)).cell.px_per_m; without > most)
        most = without, name = measured[i].name;
    if (most > kMuch * px_per_m)
      std::fprintf(stderr,
                   "skel-animate: note: %s reaches farthest and sets the scale of all: a metre is %.1f px, "
                   "without it %.1f\n",
                   printable(name).c_str(), px_per_m, most);
  }

  // The cell of a sheet that is about to be written over; nothing of one that does not tell.
  static std::optional<SpriteCell> cellBefore(const std::string& atlas) {
    std::error_code unknown;
    if (!fs::is_regular_file(atlas, unknown)) return std::nullopt;
    const LookAtOutputs look;
    try {
      return readSpriteCell(atlas);
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  // Where that has another scale its frames are kept, for --like. Returns whether it has.
  static bool keepOtherScale(const std::string& atlas, const SpriteCell& before, const SpriteCell& cell) {
    constexpr double kSame = 1e-3;
    if (before.width != cell.width || before.height != cell.height || before.pitch_deg != cell.pitch_deg ||
        std::abs(before.px_per_m - cell.px_per_m) < kSame * cell.px_per_m)
      return false;
    const std::string kept = freeNumberedName(fs::path(atlas).replace_extension(".old").string(), ".json");
    const LookAtOutputs look;
    writeFile(kept, readFile(atlas));
    std::fprintf(stderr,
                 "skel-animate: note: a metre is %.1f px now, in the sheets before it was %.1f; --like %s "
                 "makes sheets at that scale again\n",
                 cell.px_per_m, before.px_per_m, shellWord(kept).c_str());
    return true;
  }

  // "looking left (if not: --facing cat=90, or 0 if it looks at you)"; a model is turned.
  std::string toldFrom(const CharacterFile& file) const {
    const double facing_rad = facing(file.character);
    const std::string drawn = drawnFrom(facing_rad);
    if (drawn == drawnFrom(0) || options.angles(file.name) != 0) return drawn;
    const bool is_drawing =
        std::any_of(options.files.begin(), options.files.end(), [&](const std::string& path) {
          return isDrawing({.path = path}) && fs::path(path).stem() == file.name;
        });
    const long deg = std::lround(facing_rad * 180 / std::numbers::pi);
    if (is_drawing)
      return drawn + " (if not: --facing " + shellWord(file.name + "=" + std::to_string(-deg)) +
             ", or 0 if it looks at you)";
    return drawn + " (if it looks at you: --angle " + shellWord(file.name + "=" + std::to_string(-deg)) + ")";
  }

  // What differs from the sheet that is about to be written over.
  void tellOf(const std::string& atlas, const SpriteCell& cell, const std::string& name) {
    if (options.sheet.same_scale && !std::exchange(who_is_told, true)) tellWhoSetsScale(cell.px_per_m);
    const std::optional<SpriteCell> before = cellBefore(atlas);
    if (!before) return;
    if (options.sheet.same_scale && !other_is_kept) other_is_kept = keepOtherScale(atlas, *before, cell);
    if (const std::string now = degreesText(cell.angle_deg), then = degreesText(before->angle_deg);
        now != then)
      std::fprintf(stderr,
                   "%s: note: the sheet before was turned by --angle %s, this one by %s; --angle %s turns it "
                   "as before\n",
                   printable(name).c_str(), then.c_str(), now.c_str(), shellWord(name + "=" + then).c_str());
  }

  // Of the clip that reaches farthest.
  void noteBeyondCell(const CharacterFile& file, const std::vector<Clip>& clips,
                      const std::vector<SpriteDirection>& directions) const {
    BeyondCell farthest;
    std::string name;
    for (const Clip& clip : clips) {
      const BeyondCell beyond = beyondCell(
          spriteExtent(file.character, outermostPoints(file.character, {clip}), directions, pitch_rad()),
          *like);
      if (beyond.px <= farthest.px) continue;
      farthest = beyond;
      name = clip.name;
    }
    if (farthest.px > 0)
      std::fprintf(stderr,
                   "%s: note: reaches %d px beyond the cell of %s (%s, in \"%s\"), and is cut off there\n",
                   printable(file.name).c_str(), farthest.px, printable(options.sheet.like).c_str(),
                   farthest.where, printable(name).c_str());
  }

  void write(CharacterFile file, const std::vector<Clip>& asked) {
    const std::string path = pathOf(file);
    const RiggedCharacter& character = file.character;
    const std::vector<SpriteDirection> directions = directionsOf(file);
    std::vector<Clip> clips;
    for (const Clip& clip : asked) {
      InPlace moved = inPlace(clip, character);
      if (moved.travels)
        std::fprintf(stderr,
                     "%s: note: \"%s\" goes %.1f m from where it begins; the sheet shows it in place\n",
                     printable(file.name).c_str(), printable(clip.name).c_str(), moved.way_m);
      clips.push_back(std::move(moved.clip));
    }
    SpriteCamera camera = like                       ? spriteCamera(*like)
                          : options.sheet.same_scale ? cameraFor(sharedExtent())
                                                     : cameraFor(extentOf(file, clips));
    camera.cell.angle_deg = options.angles(file.name);
    if (like) noteBeyondCell(file, clips, directions);
    const SpritePacking packing = options.sheet.trim ? SpritePacking::kTrimmed : SpritePacking::kEven;
    const std::vector<SpriteTag> tags = tagsOf(clips, directions, camera.cell, packing);
    tellOf(atlasOf(path), camera.cell, file.name);
    struct Moment {
      const Clip* clip;
      double time_s;
      Camera camera;
    };
    std::vector<Moment> moments;
    std::vector<Sprite> sprites;
    for (std::size_t k = 0; k < tags.size(); ++k) {
      const Clip& clip = clips[k / directions.size()];
      const SpriteDirection& direction = directions[k % directions.size()];
      const int count = frameCount(clip);
      const double duration_s = double(clip.duration_s());
      const auto ms = [&](int i) { return int(std::lround(duration_s * 1000 * i / count)); };
      for (int i = 0; i < count; ++i) {
        moments.push_back({&clip, duration_s * i / count, turned(camera, character, direction.yaw_rad)});
        sprites.push_back({tags[k].name + "-" + std::to_string(i), std::max(1, ms(i + 1) - ms(i)), {}});
      }
    }
    const Scene scene(character, painterFor(options, character.mesh));
    std::vector<Image> images(sprites.size());
    {
      ProgressBar bar("sprites", sprites.size());
      parallelFor(sprites.size(), scene.isConcurrent() ? 0 : 1, [&](std::size_t i) {
        images[i] = paint(scene, *moments[i].clip, moments[i].time_s, moments[i].camera);
        bar.advance();
      });
    }
    if (!palette.empty())
      takeColors(images, palette);
    else if (most_colors > 0)
      reduceColors(images, most_colors);
    if (options.sheet.outline) {
      const Color dark = darkestColor(images);
      for (Image& image : images) addOutline(image, dark);
    }
    for (std::size_t i = 0; i < sprites.size(); ++i) sprites[i].image = std::move(images[i]);

    const SpriteSheet sheet = packSprites(sprites, tags, camera.cell, packing);
    const AtlasForm form = options.sheet.atlas == "array"  ? AtlasForm::kArray
                           : options.sheet.atlas == "hash" ? AtlasForm::kHash
                                                           : AtlasForm::kAseprite;
    writeFile(path, encodePng(sheet.picture, 9));
    writeFile(atlasOf(path),
              formatAtlas(sprites, tags, camera.cell, sheet, form, fs::path(path).filename().string()));
    const std::string drawn = directions.size() > 1 ? "; taken for drawn " + toldFrom(file) : std::string();
    std::printf("%s: %zu %s of %dx%d, %zu %s, %dx%d px%s\n", printable(path).c_str(), sprites.size(),
                sprites.size() == 1 ? "frame" : "frames", size.width, size.height, tags.size(),
                tags.size() == 1 ? "animation" : "animations", sheet.picture.width, sheet.picture.height,
                drawn.c_str());
  }
};

}  // namespace

CharacterRenderer sheetRenderer(const RenderCommandOptions& options) {
  const auto sheets = std::make_shared<Sheets>(options);
  CharacterRenderer renderer{[sheets](Performer one) {
    sheets->write(std::move(one.file), one.clips);
    return false;
  }};
  if (options.sheet.same_scale)
    renderer.measure = [sheets](const Performer& one) { sheets->measure(one.file, one.clips); };
  return renderer;
}

}  // namespace skel
