// Pictures and figures of the built-in clips on drawings, for script/clip-sheet and for whoever makes a clip.
//   clip_sheet OUT.png TEMPLATE CLIP,... FRAMES YAW_DEG SIZE_PX DRAWING...
// A row a drawing; FRAMES 0: one telling moment of each clip.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "libskel/animation/clip_library.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/draw/canvas.h"
#include "libskel/draw/render_mesh.h"
#include "libskel/image/write_image.h"
#include "tests/support/clips_on_drawings.h"

namespace skel {
namespace {

Image posed(const RiggedCharacter& character, const Clip& clip, float time_s, double yaw_rad, int size) {
  const Eigen::MatrixX3f vertices = posedVertices(character, clip, time_s);
  const float height_m = heightOf(character.mesh);
  // The same camera for all moments, so that steps and jumps show.
  Camera camera = framingCamera(character.mesh.vertices, yaw_rad, 0.08);
  camera.view_height_m = std::max(camera.view_height_m, 1.15 * double(height_m)) * 1.2;
  camera.target.y() += 0.04 * double(height_m);
  return renderMesh(vertices, character.mesh, camera, {.width = size, .height = size});
}

void run(int argc, char** argv) {
  if (argc < 8)
    throw UsageError("usage: clip_sheet OUT.png TEMPLATE CLIP,... FRAMES YAW_DEG SIZE_PX DRAWING...");
  const std::vector<Clip> library = clipsFor(builtinClips(), loadTemplate(argv[2]));
  std::vector<Clip> clips;
  for (std::string names = std::string(argv[3]) + ","; !names.empty();) {
    clips.push_back(clipNamed(library, names.substr(0, names.find(','))));
    names.erase(0, names.find(',') + 1);
  }
  const int frames = std::atoi(argv[4]), size = std::atoi(argv[6]);
  const double yaw_rad = std::atof(argv[5]) * M_PI / 180;
  std::vector<Panel> panels;
  for (int i = 7; i < argc; ++i) {
    const RiggedDrawing drawing = rigWithClips(argv[i], argv[2], clips);
    if (!drawing.found()) throw InputError(argv[i], drawing.silhouette.reason);
    for (const Clip& clip : drawing.clips)
      for (int frame = 0; frame < std::max(frames, 1); ++frame) {
        const float share = frames > 0 ? float(frame) / float(frames) : 0.45f;
        char label[80];
        std::snprintf(label, sizeof label, "%s %.2f", clip.name.c_str(), double(share * clip.duration_s()));
        panels.push_back({posed(drawing.character, clip, share * clip.duration_s(), yaw_rad, size),
                          frames > 0 ? label : clip.name});
      }
  }
  const int columns = int(clips.size()) * std::max(frames, 1);
  writeFile(argv[1], encodePng(montage(panels, {.columns = columns, .gap_px = 4, .label_height_px = 7})));
}

}  // namespace
}  // namespace skel

int main(int argc, char** argv) {
  try {
    skel::run(argc, argv);
  } catch (const skel::Error& error) {
    std::fprintf(stderr, "clip_sheet: %s\n", error.what());
    return int(error.exitCode());
  }
}
