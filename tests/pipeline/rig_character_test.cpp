#include "libskel/pipeline/rig_character.h"

#include <sys/resource.h>

#include <fstream>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/export/write_character.h"
#include "libskel/image/read_image.h"
#include "libskel/pipeline/rig_drawing.h"
#include "libskel/silhouette/page_net.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

// A sanitizer's own memory is more than any limit.
#ifndef SKEL_SANITIZED
TEST_CASE("for want of memory rigging throws an error of ours that names the drawing, and then goes on") {
  RigInput input;
  input.image = readImage(SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png");
  input.file = "hero.png";
  RigInput large = input;
  large.image = Image(4000, 4000);
  large.mask = Plane8::Constant(4000, 4000, 255);
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  const rlimit low{pages * 4096 + (40u << 20), limit.rlim_max};
  setrlimit(RLIMIT_AS, &low);
  std::string message;
  int code = 0;
  try {
    rigCharacter(std::move(large), RigOptions());
  } catch (const Error& error) {
    code = static_cast<int>(error.exitCode()), message = error.what();
  }
  setrlimit(RLIMIT_AS, &limit);
  CHECK(message == "hero.png: needs more memory than there is");
  CHECK(code == static_cast<int>(ExitCode::kUnavailable));
  CHECK(rigCharacter(std::move(input), RigOptions()).found());
}
#endif

TEST_CASE("an input of nothing is refused, not taken for a bug of skel") {
  CHECK_THROWS_WITH(rigCharacter(RigInput(), RigOptions()), "the input: has neither a picture nor a model");
}

TEST_CASE("a sprite that is cropped to its pixels was called cut by the border, and hardly a biped") {
  const Image drawing = readImage(SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png");
  const Plane8 mask = extractSilhouette(drawing).mask;
  int left = drawing.width, right = 0, top = drawing.height, bottom = 0;
  for (int y = 0; y < drawing.height; ++y)
    for (int x = 0; x < drawing.width; ++x)
      if (mask(y, x)) {
        left = std::min(left, x), right = std::max(right, x);
        top = std::min(top, y), bottom = y;
      }
  bottom -= (bottom - top) / 20;  // through the shoes, so that they end flat
  const auto rigged = [&](int margin, bool by_mask) {
    RigInput input;
    Image& image = input.image;
    image = Image(right - left + 1 + 2 * margin, bottom - top + 1 + 2 * margin);
    image.rgba.setZero();
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x)
        if (mask(y, x)) std::copy_n(drawing.pixel(x, y), 4, image.pixel(x - left + margin, y - top + margin));
    if (by_mask) {
      input.mask = Plane8::Zero(image.height, image.width);
      for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) (*input.mask)(y, x) = image.pixel(x, y)[3];
    }
    return rigCharacter(std::move(input), RigOptions());
  };
  for (const bool by_mask : {false, true}) {
    CAPTURE(by_mask);
    const RiggedDrawing cropped = rigged(0, by_mask), wide = rigged(7, by_mask);
    CHECK(cropped.silhouette.warnings.empty());
    CHECK(cropped.silhouette.cut_sides.empty());
    CHECK(cropped.recognition.warnings == wide.recognition.warnings);
    CHECK(cropped.recognition.confidence == wide.recognition.confidence);
    CHECK(cropped.recognition.likeness == wide.recognition.likeness);
    for (std::size_t j = 0; j < wide.recognition.skeleton.joints.size(); ++j) {
      const Joint &of_cropped = cropped.recognition.skeleton.joints[j],
                  &of_wide = wide.recognition.skeleton.joints[j];
      CAPTURE(of_wide.name);
      CHECK((of_cropped.image + Eigen::Vector2d(7, 7) - of_wide.image).norm() < 0.011);
      CHECK(of_cropped.confidence == of_wide.confidence);
    }
    CHECK(cropped.character.mesh.vertices.rows() == wide.character.mesh.vertices.rows());
  }
}

TEST_CASE("a model in parts is bound by its whole front view, not by its largest part") {
  RigInput input;
  input.model = figure().mesh;
  const Eigen::RowVector3f low = input.model->vertices.colwise().minCoeff(),
                           high = input.model->vertices.colwise().maxCoeff();
  // A small pyramid that floats beside the figure.
  TriangleMesh& mesh = *input.model;
  const Eigen::Index first = mesh.vertices.rows(), last = mesh.triangles.rows();
  mesh.vertices.conservativeResize(first + 4, 3);
  mesh.vertices.bottomRows(4) << 2, 1, 0, 2.2f, 1, 0, 2.1f, 1.2f, 0, 2.1f, 1.1f, 0.1f;
  mesh.triangles.conservativeResize(last + 4, 3);
  mesh.triangles.bottomRows(4) << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  mesh.triangles.bottomRows(4).array() += static_cast<int>(first);
  mesh.uv.resize(0, 2);
  mesh.texture = Image();

  RigOptions options;
  options.body_plan = loadTemplate("biped");
  const RiggedDrawing drawing = rigCharacter(std::move(input), options);
  REQUIRE(drawing.found());
  const RiggedCharacter& character = drawing.character;
  const double unit = kModelHeight_m / (high.y() - low.y());
  const double middle = 0.5 * (low.x() + 2.2f);  // of figure and pyramid
  for (const Joint& joint : character.skeleton.joints) {
    CAPTURE(joint.name);
    CHECK(joint.position.x() > (low.x() - middle) * unit - 0.01);
    CHECK(joint.position.x() < (high.x() - middle) * unit + 0.01);
  }
  const Joint& head = character.skeleton.joints[character.skeleton.index("head")];
  CHECK(head.position.x() == Approx((0.5 * (low.x() + high.x()) - middle) * unit).margin(0.1));
}

TEST_CASE("a biped is 1.7 m high, an animal 1.2 m long or high, and both as high as was asked for") {
  const auto model = [](const std::string& drawing, const std::string& body_plan, double height_m) {
    RigInput input;
    input.image = readImage(SKEL_SOURCE_DIR "/datasets/" + drawing);
    RigOptions options;
    options.body_plan = loadTemplate(body_plan);
    options.height_m = height_m;
    return rigCharacter(std::move(input), options).character.mesh;
  };
  const auto size = [](const TriangleMesh& mesh) {
    return Eigen::Vector3f(
        (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).transpose());
  };
  const std::string boy = "characters/cap_boy.png", dog = "animals/walking_dog.png";
  CHECK(size(model(boy, "biped", 0)).y() == Approx(1.7));
  CHECK(size(model(boy, "biped", 0.3)).y() == Approx(0.3));
  const TriangleMesh animal = model(dog, "quadruped", 0);
  CHECK(std::max(size(animal).x(), size(animal).y()) == Approx(1.2));
  CHECK(size(model(dog, "quadruped", 0.5)).y() == Approx(0.5));
  // Seen from the side, both sides of it have an eye; who faces us has no face behind.
  CHECK(animal.back_uv.rows() == 0);
  CHECK(model(boy, "biped", 0).back_uv.rows() > 0);
}

TEST_CASE("no vertex follows more joints than asked for, whatever the clips stretch") {
  const int most = GENERATE(1, 2);
  CAPTURE(most);
  RigInput input;
  input.image = readImage(SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png");
  RigOptions options;
  options.skin.max_influences = most;
  const RiggedDrawing drawing = rigCharacter(std::move(input), options);
  REQUIRE(drawing.found());
  CHECK((drawing.character.weights.weights.array() > 0).rowwise().count().maxCoeff() == most);
}

TEST_CASE("a rig that stops after a stage has what the whole has up to there, and nothing more") {
  RigInput input;
  input.image = readImage(SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png");
  RigOptions options = rigOptions("biped");
  const RiggedDrawing whole = rigCharacter(input, options);
  REQUIRE(whole.clips.size() > 1);
  for (const LastStage last : {LastStage::kSilhouette, LastStage::kClasses, LastStage::kJoints,
                               LastStage::kLayers, LastStage::kModel}) {
    CAPTURE(int(last));
    options.last = last;
    const RiggedDrawing drawing = rigCharacter(input, options);
    CHECK((drawing.silhouette.mask == whole.silhouette.mask).all());
    CHECK(drawing.candidates.maxima.empty() == (last < LastStage::kClasses));
    CHECK((drawing.classes.rows() == whole.classes.rows()) == (last >= LastStage::kClasses));
    const std::vector<Joint>& joints = drawing.recognition.skeleton.joints;
    CHECK(joints.empty() == (last < LastStage::kJoints));
    CHECK(joints.size() == (last < LastStage::kJoints ? 0 : drawing.character.skeleton.joints.size()));
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const Joint& expected = whole.recognition.skeleton.joints[j];
      CHECK(joints[j].image == expected.image);
      CHECK(joints[j].confidence == expected.confidence);
      if (last == LastStage::kModel) CHECK(joints[j].position == expected.position);
    }
    CHECK((drawing.layers.part.size() > 0) == (last >= LastStage::kLayers));
    CHECK((drawing.character.mesh.vertices.rows() > 0) == (last == LastStage::kModel));
    if (last == LastStage::kModel) CHECK(drawing.character.mesh.vertices == whole.character.mesh.vertices);
    CHECK(drawing.clips.empty());
  }
}

TEST_CASE("the model of a drawing that was photographed in dim light wears paper that is white") {
  const auto whiteShare = [](const Image& picture) {
    Eigen::Index white = 0;
    for (Eigen::Index i = 0; i < picture.rgba.rows(); ++i)
      white += picture.rgba.row(i).head<3>().minCoeff() > 240;
    return double(white) / double(picture.rgba.rows());
  };
  RigOptions options = rigOptionsWithoutClips("biped");
  options.last = LastStage::kModel;
  RigInput input;
  input.image = readImage(SKEL_SOURCE_DIR "/datasets/characters/crayon_king.png");
  const bool given_mask = GENERATE(false, true);
  if (given_mask) input.mask = readMask(SKEL_SOURCE_DIR "/datasets/characters/crayon_king.mask.png");
  const RiggedDrawing photo = rigCharacter(input, options);
  CHECK((photo.image.rgba == input.image.rgba).all());
  CHECK(whiteShare(photo.image) == 0);
  CHECK(whiteShare(photo.character.mesh.texture) > 0.04);

  input = {};
  input.image = readImage(SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png");
  const RiggedDrawing tidy = rigCharacter(input, options);
  CHECK(&tidy.colors() == &tidy.image);
}

TEST_CASE("nets that are handed over do what those do that are compiled in") {
  const auto bytesOf = [](const char* file) {
    return readFile(std::string(SKEL_SOURCE_DIR "/weights/") + file);
  };
  const std::string page = bytesOf("page_net.bin"), biped = bytesOf("joint_net.bin");
  RigInput input;
  input.image = readImage(SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png");
  RigOptions options;
  options.body_plan = loadTemplate("biped");
  const RiggedDrawing expected = rigCharacter(input, options);
  options.silhouette.page_net = std::make_shared<const PageNet>(readyToRun(parsePageNet(page, "page")));
  options.joint_nets =
      std::make_shared<const JointNets>(std::vector<JointNets::File>{{"biped", biped, "biped"}});
  const RiggedDrawing drawing = rigCharacter(input, options);
  CHECK((drawing.silhouette.mask == expected.silhouette.mask).all());
  for (std::size_t j = 0; j < expected.recognition.skeleton.joints.size(); ++j)
    CHECK(drawing.recognition.skeleton.joints[j].image == expected.recognition.skeleton.joints[j].image);

  options.joint_nets = std::make_shared<const JointNets>(std::vector<JointNets::File>{});
  CHECK_THROWS_AS(rigCharacter(input, options), UsageError);
  const std::string damaged = biped.substr(9);
  options.joint_nets =
      std::make_shared<const JointNets>(std::vector<JointNets::File>{{"biped", damaged, "biped"}});
  CHECK_THROWS_AS(rigCharacter(input, options), InputError);
}

TEST_CASE("line art on a clear ground is rigged as on paper: white within its lines") {
  RigInput input;
  input.image = readImage(SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png");
  const Silhouette solid = extractSilhouette(input.image);
  REQUIRE(solid.found());
  Image& image = input.image;
  image.rgba.setZero();
  for (const Polygon& contour : solid.outline)
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Eigen::Vector2d &a = contour[i], &b = contour[(i + 1) % contour.size()];
      const int steps = int(std::ceil((b - a).norm()));
      for (int k = 0; k < steps; ++k) {
        const Eigen::Vector2d p = a + double(k) / steps * (b - a);
        for (int y = -2; y <= 2; ++y)
          for (int x = -2; x <= 2; ++x) {
            const int u = int(std::lround(p.x())) + x, v = int(std::lround(p.y())) + y;
            if (u >= 0 && v >= 0 && u < image.width && v < image.height) image.pixel(u, v)[3] = 255;
          }
      }
    }
  RigOptions options;
  options.body_plan = loadTemplate("biped");
  const RiggedDrawing drawing = rigCharacter(std::move(input), options);
  REQUIRE(drawing.found());
  CHECK(double((drawing.silhouette.mask != 0).count()) > .97 * double((solid.mask != 0).count()));
  const Eigen::Vector2d body =
      drawing.recognition.skeleton.joints[drawing.recognition.skeleton.index("body")].image;
  CHECK(int(drawing.image.pixel(int(body.x()), int(body.y()))[0]) == 255);
}

TEST_CASE("a drawing that stands on its head gives an upright model, its joints stay the picture's") {
  RigInput input;
  input.image = readImage(SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png");
  const Image upright = input.image;
  for (int i = 0; i < input.image.width * input.image.height; ++i)
    input.image.rgba.row(i) = upright.rgba.row(upright.width * upright.height - 1 - i);
  RigOptions options;
  options.body_plan = loadTemplate("biped");
  const RiggedDrawing drawing = rigCharacter(std::move(input), options);
  REQUIRE(drawing.found());
  REQUIRE(std::abs(drawing.recognition.turned_deg - 180) < 30);
  const Skeleton& skeleton = drawing.character.skeleton;
  const Joint &head = skeleton.joints[skeleton.index("head")],
              &pelvis = skeleton.joints[skeleton.index("pelvis")];
  CHECK(head.position.y() > pelvis.position.y() + 0.3);
  CHECK(head.image.y() > pelvis.image.y() + 50);
  CHECK(drawing.character.mesh.vertices.col(1).minCoeff() == Approx(0).margin(1e-5));
}

TEST_CASE("joints that somebody placed upright are not turned upside down, nor any by whoever says so") {
  const Image image = readImage(SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png");
  RigOptions options;
  options.body_plan = loadTemplate("biped");
  options.last = LastStage::kJoints;
  RigInput drawn;
  drawn.image = image;
  const Skeleton upright = rigCharacter(std::move(drawn), options).recognition.skeleton;
  const auto turned = [&](int found_deg) {
    RigInput input;
    input.image = image;
    input.skeleton = upright;
    input.turned_deg = found_deg;
    return rigCharacter(std::move(input), options).recognition.turned_deg;
  };
  CHECK(turned(180) == 0);
  CHECK(turned(160) == 0);
  CHECK(turned(60) == 60);  // one who leans
  options.upright = true;
  CHECK(turned(60) == 0);
}

TEST_CASE("an animal whose body plan was chosen is rigged as one whose plan was named") {
  const std::string dog = SKEL_SOURCE_DIR "/datasets/animals/walking_dog.png";
  const RiggedDrawing chosen = rigDrawing(dog, rigOptions("auto")),
                      named = rigDrawing(dog, rigOptions("quadruped"));
  CHECK(chosen.body_plan.name == "quadruped");
  const bool same =
      encodeGlb(chosen.character, chosen.clips, {}) == encodeGlb(named.character, named.clips, {});
  CHECK(same);
}
