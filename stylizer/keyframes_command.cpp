#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/json.h"
#include "libskel/core/json_names.h"
#include "libskel/core/new_folders.h"
#include "libskel/core/progress.h"
#include "libskel/core/text.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/write_image.h"
#include "libskel/skeleton/joint_json.h"
#include "libskel/video/frame_file.h"
#include "libskel/video/normalize_figure.h"
#include "stylizer/commands.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKeyframesFormat = "skel-keyframes";
constexpr const char* kDistancesFormat = "skel-distances";
constexpr int kMostInMatrix = 4000;

// Light where frames are far apart.
Image matrixPicture(const Eigen::MatrixXd& matrix) {
  return magnified(heatMap(matrix.cast<float>().array() + 1e-6f), matrix.rows() < 100 ? 6 : 2);
}

double meanArea(const std::vector<FrameOutline>& outlines, const std::vector<int>& keys) {
  double sum = 0;
  for (const int key : keys) sum += outlines[std::size_t(key)].area_px;
  return std::max(1., sum / double(keys.size()));
}

[[noreturn]] void refuseForeign(const fs::path& path) {
  throw OutputError(path.string(),
                    "is not one of skel-style's; move it away, or name another folder with -o");
}

// Whether the file is there, of that format. Throws OutputError where it is somebody else's.
std::optional<JsonDocument> earlier(const fs::path& path, const char* format) {
  if (!fs::exists(path)) return std::nullopt;
  const LookAtOutputs look;
  try {
    JsonDocument document = JsonDocument::readFile(path.string());
    if (document.root().at("format").asString() == format) return document;
  } catch (const InputError&) {
  }
  refuseForeign(path);
}

// What an earlier run has written into a folder, which a new one replaces as a whole. Throws OutputError:
// pictures or files of those names that none has written.
class EarlierKeys {
 public:
  EarlierKeys(const fs::path& dir, bool with_matrix)
      : dir_(dir), pictures_(checkFrames(dir.string(), "key-")) {
    std::set<std::string> known;
    if (const auto keyframes = earlier(dir / "keyframes.json", kKeyframesFormat))
      for (const JsonValue& key : keyframes->root().at("keys").items())
        known.insert(key.at("picture").asString());
    refuseOtherFrames(dir.string(), pictures_, known);
    const fs::path picture = dir / "distances.png";
    if (earlier(dir / "distances.json", kDistancesFormat))
      matrix_ = {"distances.json", "distances.png"};
    else if (with_matrix && fs::exists(picture))
      refuseForeign(picture);
  }

  void removeAllBut(const std::set<std::string>& pictures, bool with_matrix) const {
    for (const std::string& name : pictures_)
      if (!pictures.contains(name)) fs::remove(dir_ / name);
    if (!with_matrix)
      for (const std::string& name : matrix_) fs::remove(dir_ / name);
  }

 private:
  fs::path dir_;
  std::vector<std::string> pictures_, matrix_;
};

}  // namespace

ExitCode runKeyframes(const KeyframesOptions& options) {
  std::error_code unknown;
  if (fs::equivalent(options.film.path, options.output, unknown))
    throw UsageError(options.output + " holds the frames; name another folder with -o");
  const NewFolders folders(options.output + "/");
  ensureWritableFolder(options.output);
  const EarlierKeys earlier_keys(options.output, options.matrix);
  for (const char* name : {"keyframes.json", "distances.json", "distances.png"})
    noteOutput((fs::path(options.output) / name).string());
  Image background;
  const FilmInfo info = lookAtFilm(options.film, background);
  sayUnusedRate(options.film);
  if (options.matrix && info.frames > kMostInMatrix)
    throw InputError(options.film.path, "has " + std::to_string(info.frames) + " frames; --matrix takes " +
                                            std::to_string(kMostInMatrix) + " at most");
  std::vector<FrameOutline> outlines(static_cast<std::size_t>(info.frames));
  std::vector<double> times_s(outlines.size());
  {
    ProgressBar bar("outlines", outlines.size());
    forEachFrame(options.film, info, background, [&](std::size_t i, FilmFrame& frame) {
      outlines[i] = outlineOf(frame.figure);
      times_s[i] = frame.video.time_s;
      bar.advance();
    });
  }
  if (std::all_of(outlines.begin(), outlines.end(), [](const auto& o) { return o.points.empty(); }))
    throw InputError(options.film.path, "shows no figure in any frame");
  Eigen::MatrixXd matrix;
  Eigen::VectorXd successive;
  double largest = 0;
  if (options.matrix) {
    ProgressBar bar("distances", outlines.size());
    matrix = distanceMatrix(outlines, 0, [&] { bar.advance(); });
    successive = matrix.diagonal(1);
    largest = matrix.maxCoeff();
  } else {
    successive = successiveDistances(outlines);
    largest = successive.size() > 0 ? successive.maxCoeff() : 0;
  }
  const std::vector<int> keys = keyFrames(successive, options.threshold, largest);
  const double area_px = meanArea(outlines, keys);

  using Json = nlohmann::ordered_json;
  Json root = {{"format", kKeyframesFormat},
               {"version", 1},
               {"source", jsonFromFileName(options.film.path)},
               {"frames", info.frames},
               {"threshold", options.threshold},
               {"largest_distance_px", rounded(largest, 1e4)},
               {"area_px", rounded(area_px, 100)},
               {"distances", Json::array()},
               {"keys", Json::array()}};
  for (const double d : successive) root["distances"].push_back(largest > 0 ? rounded(d / largest, 1e6) : 0);
  // The pictures of the key frames, normalised: the film is read once more rather than kept whole.
  std::vector<std::string> names;
  for (const int key : keys) {
    char name[32];
    std::snprintf(name, sizeof name, "key-%04d.png", key + 1);
    const FrameTransform t = normalizeFigure(outlines[std::size_t(key)], area_px);
    names.emplace_back(name);
    root["keys"].push_back({{"frame", key},
                            {"time_s", rounded(times_s[std::size_t(key)], 1e6)},
                            {"picture", name},
                            {"scale", t.scale},
                            {"shift", {t.shift.x(), t.shift.y()}}});
  }
  forEachFrame(options.film, info, background, [&](std::size_t i, FilmFrame& frame) {
    const auto at = std::lower_bound(keys.begin(), keys.end(), int(i));
    if (at == keys.end() || *at != int(i)) return;
    Image& image = frame.video.image;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        if (frame.figure(y, x) == 0) image.pixel(x, y)[3] = 0;
    writeFile((fs::path(options.output) / names[std::size_t(at - keys.begin())]).string(),
              encodeFrame(transformed(image, normalizeFigure(outlines[i], area_px))));
  });
  earlier_keys.removeAllBut({names.begin(), names.end()}, options.matrix);
  writeFile((fs::path(options.output) / "keyframes.json").string(), root.dump(1) + "\n");
  if (options.matrix) {
    Json rows = Json::array();
    for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
      Json row = Json::array();
      for (Eigen::Index c = 0; c < matrix.cols(); ++c)
        row.push_back(largest > 0 ? rounded(matrix(r, c) / largest, 1e6) : 0);
      rows.push_back(std::move(row));
    }
    writeFile(
        (fs::path(options.output) / "distances.json").string(),
        Json{{"format", kDistancesFormat}, {"version", 1}, {"distances", std::move(rows)}}.dump() + "\n");
    writeFile((fs::path(options.output) / "distances.png").string(), encodePng(matrixPicture(matrix)));
  }
  std::printf("%s: %d of %d frames are key frames\n", printable(options.output).c_str(), int(keys.size()),
              info.frames);
  const double most = largest > 0 ? successive.maxCoeff() / largest : 0;
  if (info.frames > 2 && keys.size() == 2 && most > 0)
    std::fprintf(
        stderr,
        "%s: note: no frame but the first and the last: successive ones differ by at most %.2f of the "
        "largest distance; give a --threshold below that\n",
        printable(options.output).c_str(), most);
  return ExitCode::kDone;
}

}  // namespace skel
