// COCO annotations; what is read becomes a mask and labels, and is written again.
#include "labeler/annotated_drawing.h"
#include "libskel/labels/label_folder.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const SkeletonTemplate body_plan = loadTemplate("biped");
  fileOf("", "a.png");
  fileOf("", "b.png");
  mayRefuse([&] {
    std::vector<CocoPicture> pictures;
    for (const AnnotatedDrawing& drawing :
         readCoco(fileOf(textOf(data, size), "fuzz.coco.json"), {body_plan})) {
      const std::string name = drawing.image.substr(drawing.image.rfind('/') + 1);
      require(name == "a.png" || name == "b.png", "only pictures of its folder are named");
      const Plane8 mask = maskFromPolygons(drawing.mask_polygons, 32, 24);
      require(mask.rows() == 24 && mask.cols() == 32, "a mask has the picture's size");
      pictures.push_back({name, 32, 24, drawing.joints, drawing.recognized, drawing.mask_polygons});
    }
    const std::vector<AnnotatedDrawing> again =
        readCoco(fileOf(formatCoco(pictures, {body_plan}), "again.coco.json"), {body_plan});
    require(again.size() == pictures.size(), "what is written is read again");
  });
  return 0;
}
