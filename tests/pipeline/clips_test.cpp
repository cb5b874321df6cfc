// The built-in clips on all drawings of the repository.
#include <algorithm>
#include <filesystem>
#include <map>

#include "libskel/animation/clip_library.h"
#include "libskel/pipeline/rig_drawing.h"
#include "tests/support/catch.h"
#include "tests/support/clips_on_drawings.h"

using namespace skel;

namespace {

using Eigen::Vector3f;

// Every so many of them: a sample of all views and styles that does not take long.
std::vector<std::string> drawings(const char* folder, std::size_t every) {
  std::vector<std::string> all, some;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(SKEL_SOURCE_DIR "/datasets/") + folder))
    if (const std::string path = entry.path().string(); path.ends_with(".joints.json"))
      all.push_back(path.substr(0, path.size() - 12) + ".png");
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i < all.size(); i += every) some.push_back(all[i]);
  return some;
}

RiggedDrawing rigged(const std::string& path, const std::string& body_plan) {
  RiggedDrawing drawing = rigWithClips(path, body_plan, clipsFor(builtinClips(), loadTemplate(body_plan)));
  REQUIRE(drawing.found());
  return drawing;
}

std::vector<Vector3f> places(const Skeleton& skeleton, const Clip& clip, float time_s,
                             float height_m = float(kModelHeight_m)) {
  return posedJoints(skeleton, posedFromRest(skeleton, samplePose(clip, skeleton, time_s), height_m));
}

// How far feet that stand leave the place that runs evenly with the ground, in heights.
float slide(const Skeleton& skeleton, const Clip& clip, const std::vector<FootContact>& contacts,
            float height_m) {
  const auto at = [&](const FootContact& contact, float share) {
    const float time_s = contact.from_s + share * (contact.to_s - contact.from_s);
    return places(skeleton, clip, time_s, height_m)[skeleton.index(contact.joint)];
  };
  Vector3f run = Vector3f::Zero();
  float stood_s = 0;
  for (const FootContact& contact : contacts) {
    run += at(contact, 1) - at(contact, 0);
    stood_s += contact.to_s - contact.from_s;
  }
  run /= stood_s;
  float worst = 0;
  for (const FootContact& contact : contacts) {
    const float length_s = contact.to_s - contact.from_s;
    Vector3f mean = Vector3f::Zero();
    for (int i = 0; i <= 10; ++i)
      mean += (at(contact, float(i) / 10) - (float(i) / 10 - 0.5f) * length_s * run) / 11;
    for (int i = 0; i <= 10; ++i) {
      const float share = float(i) / 10;
      worst = std::max(worst, (at(contact, share) - mean - (share - 0.5f) * length_s * run).norm());
    }
  }
  return worst / height_m;
}

// One who was drawn bent to the ground, or lying, stands on no feet that could stay where they are.
bool standsUpright(const Skeleton& skeleton) {
  const Eigen::Vector3d trunk =
      skeleton.joints[skeleton.index("neck")].position - skeleton.joints[skeleton.index("pelvis")].position;
  return trunk.normalized().y() > 0.7;
}

void checkClips(const std::string& path, const std::string& body_plan, std::map<std::string, float>& worst) {
  const RiggedDrawing drawing = rigged(path, body_plan);
  const Skeleton& skeleton = drawing.character.skeleton;
  const auto heights = drawing.character.mesh.vertices.col(1);
  const float height_m = heights.maxCoeff() - heights.minCoeff();
  if (body_plan == "biped" && !standsUpright(skeleton)) return;
  const std::vector<Clip> made = clipsFor(builtinClips(), loadTemplate(body_plan));
  REQUIRE(drawing.clips.size() == made.size());
  for (std::size_t c = 0; c < made.size(); ++c) {
    const Clip& clip = drawing.clips[c];
    CAPTURE(path, clip.name);
    // Loops close, and what leads from the drawn pose begins and ends there.
    const std::vector<Vector3f> first = places(skeleton, clip, 0, height_m),
                                last = places(skeleton, clip, clip.duration_s(), height_m);
    for (std::size_t j = 0; j < first.size(); ++j) {
      CHECK((first[j] - last[j]).norm() < 0.002f * height_m);
      if (made[c].lead_s > 0)
        CHECK((first[j] - skeleton.joints[j].position.cast<float>()).norm() < 1e-4f * height_m);
    }
    // A clip from the drawn pose has its feet on the ground between its leads only.
    std::vector<FootContact> contacts = made[c].contacts;
    for (FootContact& contact : contacts) {
      contact.from_s = std::max(contact.from_s, made[c].lead_s);
      contact.to_s = std::min(contact.to_s, clip.duration_s() - made[c].lead_s);
    }
    if (contacts.empty()) continue;
    const float slid = slide(skeleton, clip, contacts, height_m);
    worst[body_plan + " " + clip.name] = std::max(worst[body_plan + " " + clip.name], slid);
    CHECK(slid < (clip.name == "walk" ? 0.006f : 0.03f));
  }
}

void report(const std::map<std::string, float>& worst) {
  for (const auto& [clip, slid] : worst) UNSCOPED_INFO(clip << ": " << 100 * slid << " % of the height");
}

}  // namespace

TEST_CASE("feet that stand do not slide, loops close, on drawings of all views") {
  std::map<std::string, float> worst;
  for (const std::string& path : drawings("characters", 3)) checkClips(path, "biped", worst);
  for (const std::string& path : drawings("animals", 2)) checkClips(path, "quadruped", worst);
  report(worst);
  CHECK(worst.size() == 15);
}

TEST_CASE("an animal that is asked to wag its tail is seen to do it") {
  for (const std::string name : {"box_dog", "grazing_cow", "sitting_cat", "trotting_horse"}) {
    CAPTURE(name);
    const RiggedDrawing drawing = rigged(SKEL_SOURCE_DIR "/datasets/animals/" + name + ".png", "quadruped");
    const RiggedCharacter& character = drawing.character;
    const Clip& wag = clipNamed(drawing.clips, "wag");
    const float height_m = heightOf(character.mesh);
    const Joint& tail = character.skeleton.joints[std::size_t(character.skeleton.index("tail"))];
    const Eigen::RowVector2f at = tail.position.head<2>().cast<float>().transpose();
    Eigen::Index tip = 0;
    (character.mesh.vertices.leftCols<2>().rowwise() - at).rowwise().squaredNorm().minCoeff(&tip);
    float most = 0;
    for (int k = 0; k < 24; ++k) {
      const Eigen::MatrixX3f posed = posedVertices(character, wag, wag.duration_s() * float(k) / 24);
      most = std::max(most, (posed.row(tip) - character.mesh.vertices.row(tip)).head<2>().norm());
    }
    CHECK(most > 0.06f * height_m);
  }
}

TEST_CASE("nothing is mirrored, and a figure in side view walks within the picture") {
  const auto swing = [](const char* name, const char* clip_name, double into_picture) {
    RigOptions options = rigOptions("biped");
    options.into_picture = into_picture;
    const RiggedDrawing drawing =
        rigDrawing(std::string(SKEL_SOURCE_DIR "/datasets/characters/") + name + ".png", options);
    const Skeleton& skeleton = drawing.character.skeleton;
    const Clip& clip = clipNamed(drawing.clips, clip_name);
    const int foot = skeleton.index("left_foot"), hip = skeleton.index("left_hip");
    Vector3f low = Vector3f::Constant(1e9f), high = -low;
    for (int i = 0; i < 24; ++i) {
      const std::vector<Vector3f> at = places(skeleton, clip, clip.duration_s() * float(i) / 24);
      low = low.cwiseMin(at[foot] - at[hip]);
      high = high.cwiseMax(at[foot] - at[hip]);
    }
    return Vector3f(high - low);
  };
  const double usual = RigOptions().into_picture;
  const Vector3f ahead = swing("cap_boy", "walk", 0), front = swing("cap_boy", "walk", usual),
                 side = swing("runner", "walk", usual);
  CHECK(ahead.z() > 3 * ahead.x());
  CHECK(front.z() > 2 * front.x());
  CHECK(side.x() > 3 * side.z());

  // The right hand waves at the left of the picture, the left arm dances first at its right.
  const RiggedDrawing boy = rigged(SKEL_SOURCE_DIR "/datasets/characters/dancer.png", "biped");
  const Skeleton& skeleton = boy.character.skeleton;
  const std::vector<Vector3f> waving = places(skeleton, clipNamed(boy.clips, "wave"), 1.2f);
  CHECK(waving[skeleton.index("right_hand")].x() < waving[skeleton.index("neck")].x());
  CHECK(waving[skeleton.index("right_hand")].y() > waving[skeleton.index("left_hand")].y());
  const std::vector<Vector3f> dancing = places(skeleton, clipNamed(boy.clips, "dance"), 1);
  CHECK(dancing[skeleton.index("left_hand")].y() > dancing[skeleton.index("right_hand")].y());
}
