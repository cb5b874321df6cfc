#include "libskel/animation/clip_file.h"

#include <filesystem>
#include <fstream>

#include "libskel/animation/clip_library.h"
#include "libskel/animation/keyframe_clip.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/core/error.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"
#include "tests/support/temp_dir.h"

using namespace skel;

namespace {

std::string fileWith(const std::string& members) {
  return "{\"format\": \"skel-clip\", \"version\": 1, \"name\": \"nod\", " + members + "}";
}

Clip parsed(const std::string& members) { return parseClip(fileWith(members), "nod.clip.json"); }

void checkRefused(const std::string& members, const std::string& problem) {
  CAPTURE(members);
  CHECK_THROWS_WITH(parsed(members), "nod.clip.json: " + problem);
}

float bow(const Clip& clip, float time_s) {
  const Skeleton skeleton = figureSkeleton();
  const Eigen::Quaternionf turn = samplePose(clip, skeleton, time_s).rotations[skeleton.index("head")];
  return 2 * std::atan2(turn.x(), turn.w()) * 180 / float(M_PI);
}

}  // namespace

TEST_CASE("what is written is read as it was") {
  Clip clip;
  clip.name = "bow \"deep\"";
  clip.template_name = "biped";
  clip.frame = ClipFrame::kBody;
  clip.least_duration_s = 4;
  clip.lead_s = 0.25f;
  clip.loops = true;
  clip.root_times_s = {0, 1.5f};
  clip.root_translations = {{0, 0, 0}, {0.1f, -0.2f, 0.3f}};
  JointTrack track;
  track.joint = "head";
  track.bone = Eigen::Vector3f(1, 2, 3).normalized();
  track.slack_rad = 0.5f;
  track.times_s = {0, 0.1f, 3};
  for (const float angle : {0.0f, 0.7f, -2.0f})
    track.rotations.emplace_back(Eigen::AngleAxisf(angle, Eigen::Vector3f(1, 1, 0).normalized()));
  track.translation_times_s = {1};
  track.translations_m = {{1, 2, 3}};
  track.scale_times_s = {0, 2};
  track.scales = {{1, 1, 1}, {2, 1, 0.5f}};
  clip.tracks = {track};
  clip.contacts = {{"left_foot", 0, 2}, {"right_foot", 1, 3}};

  const Clip again = parseClip(formatClip(clip), "again");
  CHECK(again.name == clip.name);
  CHECK(again.template_name == "biped");
  CHECK(again.frame == ClipFrame::kBody);
  CHECK(again.duration_s() == 4);
  CHECK(again.lead_s == 0.25f);
  CHECK(again.loops);
  CHECK(again.root_times_s == clip.root_times_s);
  CHECK(again.root_translations == clip.root_translations);
  CHECK(again.contacts == clip.contacts);
  REQUIRE(again.tracks.size() == 1);
  CHECK(again.tracks[0].times_s == track.times_s);
  for (int k = 0; k < 3; ++k) CHECK(again.tracks[0].rotations[k].isApprox(track.rotations[k], 1e-6f));
  CHECK(again.tracks[0].translations_m == track.translations_m);
  CHECK(again.tracks[0].scales == track.scales);
  CHECK(again.tracks[0].slack_rad == Approx(0.5).margin(1e-5));
  CHECK(formatClip(again) == formatClip(parseClip(formatClip(again), "again")));
}

TEST_CASE("angles stay angles where nothing eases them") {
  const Clip clip = parsed(R"("tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [1, 270, 0, 0]]}])");
  REQUIRE(clip.tracks[0].angles_rad.size() == 2);
  CHECK(bow(clip, 0.5f) == Approx(-45).margin(0.01));  // the shorter way
  Clip linear = clip;
  linear.interpolation = RotationInterpolation::kAngles;
  CHECK(bow(linear, 0.5f) == Approx(135).margin(0.01));
  CHECK(formatClip(clip).find("[1, 270, 0, 0]") != std::string::npos);
}

TEST_CASE("keys ease as the file asks") {
  const std::string tracks =
      R"("tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [1, 40, 0, 0], [2, 60, 0, 0], [3, 0, 0, 0]]}])";
  const Clip none = parsed(tracks), rest = parsed(R"("ease": "rest", )" + tracks),
             flow = parsed(R"("ease": "flow", )" + tracks), loop = parsed(R"("ease": "loop", )" + tracks);
  for (const Clip* clip : {&none, &rest, &flow, &loop}) {
    CHECK(clip->duration_s() == 3);
    CHECK(bow(*clip, 1) == Approx(40).margin(0.01));
    CHECK(bow(*clip, 2) == Approx(60).margin(0.01));
  }
  CHECK(bow(none, 0.25f) == Approx(10).margin(0.01));
  // At a key: at rest, passing, passing; at the ends: at rest, at rest, as on the other side.
  const auto speed = [](const Clip& clip, float time_s) {
    return (bow(clip, time_s + 1 / 30.0f) - bow(clip, time_s)) * 30;
  };
  CHECK(std::abs(speed(rest, 1)) < 3);
  CHECK(speed(flow, 1) > 20);
  CHECK(std::abs(speed(flow, 0)) < 3);
  CHECK(speed(loop, 0) == Approx(speed(loop, 3 - 1 / 30.0f)).margin(12));
}

TEST_CASE("rotations ease as angles do: clips that were made in the window have these") {
  const auto turned = [](double degrees) {
    const double half = degrees * 3.14159265358979 / 360;
    return std::to_string(std::sin(half)) + ", 0, 0, " + std::to_string(std::cos(half)) + "]";
  };
  // One of the signs is turned: it is the same rotation.
  const std::string of_angles =
      R"("tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [1, 40, 0, 0], [2, 60, 0, 0], [3, 0, 0, 0]]}])";
  const std::string tracks = R"("tracks": [{"joint": "head", "rotations": [[0, )" + turned(0) + ", [1, " +
                             turned(400) + ", [2, " + turned(60) + ", [3, " + turned(360) + "]}]";
  for (const std::string ease : {"none", "rest", "flow", "loop"}) {
    const std::string how = "\"ease\": \"" + ease + "\", ";
    const Clip clip = parsed(how + tracks), angles = parsed(how + of_angles);
    INFO(ease);
    CHECK(clip.duration_s() == 3);
    for (int i = 0; i <= 30; ++i)
      CHECK(std::remainder(bow(clip, float(i) / 10) - bow(angles, float(i) / 10), 360) ==
            Approx(0).margin(1));
  }
  // A whole turn comes back with its signs turned, and goes on as it came (along chords of 120 degrees).
  const Clip whole = parsed(R"("ease": "loop", "tracks": [{"joint": "head", "rotations": [[0, )" + turned(0) +
                            ", [1, " + turned(120) + ", [2, " + turned(240) + ", [3, " + turned(360) + "]}]");
  const std::vector<Eigen::Quaternionf>& turns = whole.tracks[0].rotations;
  const float first = turns[0].angularDistance(turns[1]),
              last = turns[turns.size() - 2].angularDistance(turns.back());
  CHECK(first * kEasedRate_hz == Approx(120 * 3.14159265 / 180).epsilon(.2));
  CHECK(last == Approx(first).epsilon(.02));
  const Clip one = parsed(R"("ease": "flow", "tracks": [{"joint": "head", "rotations": [[0, 0, 0, 0, 1]]}])");
  CHECK(one.tracks[0].rotations.size() == 1);
}

TEST_CASE("a clip file that makes no sense is refused with the place in it") {
  const auto head = [](const std::string& keys) {
    return "\"tracks\": [{\"joint\": \"head\", " + keys + "}]";
  };
  checkRefused(head(R"("rotations": [[0, 0, 0, 0, 1], [0, 0, 0, 0, 1]])"),
               "tracks[0].rotations[1]: must be later than the key before");
  checkRefused(head(R"("rotations": [[-1, 0, 0, 0, 1]])"),
               "tracks[0].rotations[0]: must be a time of 0 to 3600 seconds");
  checkRefused(head(R"("rotations": [[0, 0, 0, 0, 2]])"),
               "tracks[0].rotations[0]: is no rotation: its last four numbers must have length 1");
  checkRefused(head(R"("rotations": [[0, 0, 0, 1]])"), "tracks[0].rotations[0]: has 4 numbers, must have 5");
  checkRefused(head(R"("rotations": [])"), "tracks[0].rotations: is empty");
  checkRefused(head(R"("angles_deg": [[0, 0, 0, 4000]])"),
               "tracks[0].angles_deg[0]: holds a number that is too large");
  checkRefused(head(R"("angles_deg": [[0, 0, 0, 0]], "rotations": [[0, 0, 0, 0, 1]])"),
               "tracks[0].angles_deg: stands beside \"rotations\"; give one of them");
  checkRefused(head(R"("bone": [0, 0, 0], "angles_deg": [[0, 0, 0, 0]])"),
               "tracks[0].bone: must be a direction");
  checkRefused(head(R"("slack_deg": 3, "angles_deg": [[0, 0, 0, 0]])"), "tracks[0].slack_deg: needs a bone");
  checkRefused(head(R"("bone": [0, 1, 0])"),
               "tracks[0]: has no keys; give \"rotations\", \"angles_deg\", "
               "\"translations_m\" or \"scales\"");
  const std::string one = R"({"joint": "head", "angles_deg": [[0, 0, 0, 0], [2, 0, 0, 0]]})";
  checkRefused("\"tracks\": [" + one + ", " + one + "]", "tracks[1].joint: \"head\" has a track already");
  checkRefused("\"tracks\": [" + one + R"(], "lead_s": 1.5)", "lead_s: must be at most half of the clip");
  checkRefused("\"tracks\": [" + one + R"(], "ease": "bounce")",
               "ease: is \"bounce\", must be none, rest, flow or loop");
  checkRefused("\"tracks\": [" + one + R"(], "frame": "world")",
               "frame: is \"world\", must be picture or body");
  checkRefused("\"tracks\": [" + one + R"(], "contacts": [{"joint": "left_foot", "from_s": 1, "to_s": 1}])",
               "contacts[0].to_s: must be later than from_s");
  checkRefused("\"tracks\": [" + one + R"(], "contacts": [{"joint": "left_foot", "from_s": 1, "to_s": 3}])",
               "contacts[0].to_s: lies beyond the clip's end");
}

TEST_CASE("a few bytes do not ask for endless work: long clips, eased keys, contacts") {
  checkRefused(R"("tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0]]}], "duration_s": 100000)",
               "duration_s: is 100000, must be between 0 and 3600");
  std::string tracks;
  for (int i = 0; i < 10; ++i)
    tracks += (i ? ", " : "") + ("{\"joint\": \"j" + std::to_string(i)) +
              "\", \"angles_deg\": [[0, 0, 0, 0], [3600, 1, 0, 0]]}";
  checkRefused("\"ease\": \"flow\", \"tracks\": [" + tracks + "]",
               "tracks[9].angles_deg: makes more than 1000000 keys of eased ones; cut the clip into parts");
  const std::string one = R"({"joint": "head", "angles_deg": [[0, 0, 0, 0], [2, 0, 0, 0]]})";
  std::string contacts;
  for (int i = 0; i < 1001; ++i)
    contacts += std::string(i ? ", " : "") + R"({"joint": "left_foot", "from_s": 0, "to_s": 1})";
  checkRefused("\"tracks\": [" + one + "], \"contacts\": [" + contacts + "]",
               "contacts: holds more than 1000 contacts");
}

TEST_CASE("many eased keys and many tracks are read in time") {
  // Linear searches would take minutes.
  std::string keys, tracks;
  for (int i = 0; i < 100'000; ++i)
    keys += (i ? ",[" : "[") + std::to_string(i * .03) + "," + std::to_string(i % 7) + ",0,0]";
  for (int i = 0; i < 100'000; ++i)
    tracks += ",{\"joint\":\"" + std::to_string(i) + "\",\"angles_deg\":[[0,0,0,0]]}";
  const Clip clip =
      parseClip(R"({"format": "skel-clip", "version": 1, "name": "long", "ease": "flow", "tracks": [)"
                R"({"joint": "head", "angles_deg": [)" +
                    keys + "]}" + tracks + "]}",
                "a.clip.json");
  CHECK(clip.tracks.size() == 100'001);
  CHECK(clip.tracks[0].times_s.size() == 90'000);
}

TEST_CASE("each body plan has clips of its own") {
  const auto names = [](const std::string& body_plan) {
    std::vector<std::string> list;
    for (const Clip& clip : clipsFor(builtinClips(), loadTemplate(body_plan))) list.push_back(clip.name);
    return list;
  };
  CHECK(names("biped") == std::vector<std::string>{"idle", "walk", "run", "jump", "wave", "dance", "sit",
                                                   "cheer", "greet", "talk"});
  CHECK(names("quadruped") == std::vector<std::string>{"idle", "walk", "gallop", "graze", "nod", "wag"});
  CHECK(clipsFor(builtinClips(), figureSkeleton()).size() == 10);
  CHECK_THROWS_WITH(
      clipNamed(clipsFor(builtinClips(), loadTemplate("quadruped")), "fly"),
      "there is no clip \"fly\" for this body plan; there are: idle, walk, gallop, graze, nod, wag");
}

TEST_CASE("a clip that puts the pelvis on the ground fits nobody") {
  Clip clip = parsed(R"("contacts": [{"joint": "left_foot", "from_s": 0, "to_s": 1}],
    "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [9, 0, 0, 0]]}])");
  CHECK(fits(clip, figureSkeleton()));
  CHECK(fits(clip, loadTemplate("biped")));
  clip.contacts[0].joint = "pelvis";
  CHECK_FALSE(fits(clip, figureSkeleton()));
  CHECK_FALSE(fits(clip, loadTemplate("biped")));
}

TEST_CASE("a joint that neither the figure nor the clip's own template has is named, others' clips are not") {
  const auto moving = [](const std::string& body_plan, const std::string& joint) {
    return parsed(body_plan + R"("tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [9, 0, 0, 0]]},
      {"joint": ")" +
                  joint + R"(", "angles_deg": [[0, 0, 0, 0], [9, 0, 0, 0]]}])");
  };
  const SkeletonTemplate biped = loadTemplate("biped"), quadruped = loadTemplate("quadruped");
  const std::string of_biped = R"("template": "biped", )";
  const Clip misspelt = moving(of_biped, "left_sholder");
  CHECK(faultOf(misspelt, figureSkeleton()) ==
        "moves \"left_sholder\", which this character lacks; did you mean \"left_shoulder\"?");
  for (const SkeletonTemplate& body_plan : {biped, quadruped})
    CHECK(faultOf(misspelt, body_plan) ==
          "moves \"left_sholder\", which the template \"biped\" lacks; did you mean \"left_shoulder\"?");
  CHECK(faultOf(moving("", "sadle"), biped) == "moves \"sadle\", which no template has");
  for (const Clip& clip :
       {moving(of_biped, "left_hand"), moving("", "tail"), moving(R"("template": "quadruped", )", "tail"),
        moving(of_biped, "hanging_cape_1")}) {
    CHECK(faultOf(clip, biped) == "");
    CHECK(faultOf(clip, quadruped) == "");
  }
  Clip standing = moving(of_biped, "neck");
  standing.contacts = {{"left_fot", 0, 1}};
  CHECK(faultOf(standing, biped) ==
        "puts \"left_fot\" on the ground, which the template \"biped\" lacks; did "
        "you mean \"left_foot\"?");
  Skeleton winged = figureSkeleton();
  winged.joints.push_back({"wing", 0, {}, winged.joints[0].position});
  CHECK(faultOf(moving(of_biped, "wing"), winged) == "");
  CHECK(fits(moving(of_biped, "wing"), winged));
}

TEST_CASE("an unknown clip lists each clip once, and the one that was probably meant") {
  std::vector<Clip> twice = clipsFor(builtinClips(), loadTemplate("quadruped"));
  for (const Clip& clip : clipsFor(builtinClips(), loadTemplate("quadruped"))) twice.push_back(clip);
  CHECK_THROWS_WITH(
      clipNamed(twice, "galop"),
      "there is no clip \"galop\" for this body plan; did you mean \"gallop\"? There are: idle, "
      "walk, gallop, graze, nod, wag");
}

TEST_CASE("who asks an animal for \"run\" was not told of its gallop") {
  const std::vector<Clip> animals = clipsFor(builtinClips(), loadTemplate("quadruped"));
  CHECK(meantClip("run", animals) == "gallop");
  CHECK(meantClip("dance", animals).empty());
  CHECK(meantClip("gallop", clipsFor(builtinClips(), loadTemplate("biped"))) == "run");
}

TEST_CASE("a folder of clips adds to those that come with skel and takes their place") {
  const TempDir dir;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(dir.file(name)) << text;
  };
  CHECK_THROWS_WITH(clipsWithFolder(dir.path()),
                    dir.path() + ": holds no clip; the files must end in .clip.json");
  const std::string bow =
      R"("template": "biped", "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [9, 0, 0, 0]]}])";
  write("bow.clip.json", fileWith(bow));
  write("notes.txt", "no clip");
  Clip idle = parsed(bow);
  idle.name = "idle";
  write("idle.clip.json", formatClip(idle));
  const std::vector<Clip> clips = clipsFor(clipsWithFolder(dir.path()), loadTemplate("biped"));
  CHECK(clips.size() == 11);
  CHECK(clipNamed(clips, "nod").duration_s() == 9);
  CHECK(clipNamed(clips, "idle").duration_s() == 9);
}

TEST_CASE(
    "a copy of a clip file kept its whole folder from use, and the message named one of the two files") {
  const TempDir dir;
  const std::string bow =
      R"("template": "biped", "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [9, 0, 0, 0]]}])";
  for (const char* file : {"nod.clip.json", "nod (copy).clip.json"})
    std::ofstream(dir.file(file)) << fileWith(bow);
  const std::string problem =
      dir.file("nod.clip.json") + ": is the second clip \"nod\" for the template \"biped\", after " +
      dir.file("nod (copy).clip.json") + "; change \"name\" in one of them, or remove it";
  std::vector<std::string> left_out;
  CHECK_THROWS_WITH(clipsWithFolder(dir.path(), {"walk", "nod"}, &left_out), problem);
  CHECK(left_out.empty());
  for (const std::vector<std::string>& needed : {std::vector<std::string>(), {"walk"}}) {
    left_out.clear();
    const std::vector<Clip> library = clipsWithFolder(dir.path(), needed, &left_out);
    CHECK(left_out == std::vector<std::string>{problem});
    CHECK(clipNamed(clipsFor(library, loadTemplate("biped")), "nod").duration_s() == 9);
    CHECK(library.size() == builtinClips().size() + 1);
  }
}

TEST_CASE("a broken clip file kept its whole folder from use where no clip was asked for by name") {
  const TempDir dir;
  std::ofstream(dir.file("broken.clip.json")) << "{";
  CHECK_THROWS_WITH(clipsWithFolder(dir.path()),
                    Catch::Matchers::StartsWith(dir.file("broken.clip.json") + ": is not JSON"));
  std::ofstream(dir.file("nod.clip.json")) << fileWith(
      R"("template": "biped", "tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [9, 0, 0, 0]]}])");
  std::vector<std::string> left_out;
  CHECK(clipsWithFolder(dir.path(), {}, &left_out).size() == builtinClips().size() + 1);
  CHECK(left_out.size() == 1);
  CHECK_THROWS_WITH(clipsWithFolder(dir.path(), {"broken"}), left_out[0]);
}

TEST_CASE("keys that ease come and go as they stand for who edits them") {
  for (const std::string ease : {"rest", "flow", "loop"})
    for (const std::string loop : {"", "\"loop\": true, ", "\"loop\": false, "}) {
      const std::string text = fileWith("\"ease\": \"" + ease + "\", " + loop +
                                        R"("tracks": [{"joint": "head",
          "rotations": [[0, 0, 0, 0, 1], [1, 0, 0, 0.6, 0.8], [2, 0, 0, 0, 1]]}])");
      const ClipKeys keys = parseClipKeys(text, "a");
      const Clip even = parseClip(text, "a");
      CHECK(keys.clip.tracks[0].times_s == std::vector<float>{0, 1, 2});
      CHECK(parseClipKeys(formatClipKeys(keys), "a") == keys);
      CHECK(withEvenKeys(keys) == even);
      CHECK(withEvenKeys({even}) == even);
      CHECK(even.tracks[0].times_s.size() == 61);
    }
}

TEST_CASE("an own clip without a template takes the place of those that have its joints") {
  const TempDir dir;
  const auto write = [&](const std::string& name, Clip clip) {
    std::ofstream(dir.file(name)) << formatClip(clip);
  };
  Clip own = parsed(R"("tracks": [{"joint": "head", "angles_deg": [[0, 0, 0, 0], [9, 0, 0, 0]]}])");
  own.name = "walk";
  write("walk.clip.json", own);
  const auto walks = [&](const char* body_plan) {
    std::vector<float> durations_s;
    for (const Clip& clip : clipsFor(clipsWithFolder(dir.path()), loadTemplate(body_plan)))
      if (clip.name == "walk") durations_s.push_back(clip.duration_s());
    return durations_s;
  };
  CHECK(walks("biped") == std::vector<float>{9});
  CHECK(walks("quadruped") == std::vector<float>{9});
  own.tracks[0].joint = "left_hand";  // which an animal has not
  write("walk.clip.json", own);
  CHECK(walks("biped") == std::vector<float>{9});
  const std::vector<float> animals = walks("quadruped");
  REQUIRE(animals.size() == 1);
  CHECK(animals[0] != 9);
}

TEST_CASE("key-frame clips turn by angles, move and scale, and what has no key rests") {
  const std::string text = R"({"name": "trot", "duration": 3, "keyframes": {
      "head": [{"time": 0, "rotation": [0, 0, 0]}, {"time": 2, "rotation": [0, 0, 6]}],
      "neck": [{"time": 1, "translation": [1, 2, 3], "scale": [1, 2, 3]}],
      "body": []}})";
  const Skeleton skeleton = figureSkeleton();
  const std::size_t head = std::size_t(skeleton.index("head")), neck = std::size_t(skeleton.index("neck"));
  const auto up = [&](const KeyframeClipOptions& options) {
    const Clip clip = parseKeyframeClip(text, "trot.json", skeleton, options);
    CHECK(clip.name == "trot");
    CHECK(clip.duration_s() == 3);
    CHECK(clip.tracks.size() == 2);
    return Eigen::Vector3f(samplePose(clip, skeleton, 1).rotations[head] * Eigen::Vector3f::UnitX());
  };
  const auto linear = RotationInterpolation::kAngles;
  CHECK((up({}) - Eigen::Vector3f(std::cos(3 - float(M_PI)), std::sin(3 - float(M_PI)), 0)).norm() < 1e-4f);
  CHECK((up({.z_up = false, .interpolation = linear}) - Eigen::Vector3f(std::cos(3.0f), std::sin(3.0f), 0))
            .norm() < 1e-4f);
  // About the file's z, which points up.
  CHECK((up({.z_up = true, .interpolation = linear}) - Eigen::Vector3f(std::cos(3.0f), 0, -std::sin(3.0f)))
            .norm() < 2e-3f);
  const Pose pose = samplePose(parseKeyframeClip(text, "trot.json", skeleton, {.z_up = true}), skeleton, 1);
  CHECK(pose.translations_m[neck] == Eigen::Vector3f(1, 3, -2));
  CHECK(pose.scales[neck] == Eigen::Vector3f(1, 3, 2));
}

TEST_CASE("a key-frame clip that makes no sense is refused with the place in it") {
  const auto refused = [](const std::string& keyframes, const std::string& problem) {
    CHECK_THROWS_WITH(parseKeyframeClip("{\"name\": \"trot\", \"keyframes\": " + keyframes + "}", "trot.json",
                                        figureSkeleton()),
                      "trot.json: " + problem);
  };
  refused(R"({"hoof": []})", "keyframes.hoof: \"hoof\" is no joint of the skeleton");
  refused(R"({"head": [{"time": 1}, {"time": 0.5}]})",
          "keyframes.head[1].time: must be later than the key before");
  refused(R"({"head": [{"time": 1, "rotation": [0, 1]}]})",
          "keyframes.head[0].rotation: has 2 numbers, must have 3");
  refused(R"({"head": [{"time": 1, "rotation": [0, 1, NaN]}]})",
          "is not JSON: line 1 cannot be read: keyframes.head[0].rotation[2] is not a finite number");
}

TEST_CASE("what a key-frame clip has besides is left alone, and said") {
  std::string note;
  const Clip clip = parseKeyframeClip(
      R"({"name": "trot", "fps": 24, "keyframes": {"head": [{"time": 1, "rotation": [0, 1, 0], "easing": "in"}]}})",
      "trot.json", figureSkeleton(), {}, &note);
  CHECK(clip.tracks.size() == 1);
  CHECK(note == "trot.json: fps, keyframes.head[].easing are not used");
}
