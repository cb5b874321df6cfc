// Whoever is killed while saving loses at most the step in hand.
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

#include "labeler/label_report.h"
#include "labeler/save_drawing.h"
#include "libskel/core/files.h"
#include "libskel/core/rng.h"
#include "libskel/core/sha256.h"
#include "libskel/labels/label_file.h"
#include "libskel/skeleton/motion_file.h"
#include "tests/labeler/drawing_folder.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"

using namespace skel;
namespace fs = std::filesystem;

extern char** environ;

namespace {

// Starts save_loop at `first_step`, kills it anywhere in the time that some steps take, on a slow disk as on
// a fast one; returns the last step that it has reported.
int saveUntilKilled(const std::string& opened, int first_step, Rng& rng) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  const std::string start = std::to_string(first_step), save_loop = binFolder() + "/labeler_save_loop";
  char* const arguments[] = {const_cast<char*>(save_loop.c_str()), const_cast<char*>(opened.c_str()),
                             const_cast<char*>(start.c_str()), nullptr};
  pid_t child = 0;
  REQUIRE(posix_spawn(&child, save_loop.c_str(), &actions, nullptr, arguments, environ) == 0);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);

  int last = first_step - 1;
  const auto readStep = [&] { return read(ends[0], &last, sizeof last) == sizeof last; };
  REQUIRE(readStep());  // it is at work
  const auto start_of_step = std::chrono::steady_clock::now();
  REQUIRE(readStep());
  const std::chrono::duration<double, std::micro> step_us = std::chrono::steady_clock::now() - start_of_step;
  usleep(static_cast<useconds_t>(rng.uniform(0, 5) * step_us.count()));
  kill(child, SIGKILL);
  while (readStep()) {
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
  return last;
}

int savedStep(const LabelFile& labels) {
  for (const auto& [name, place] : labels.joints)
    if (name == "head") return static_cast<int>(place->x()) + 500 * static_cast<int>(place->y());
  return -1;
}

}  // namespace

TEST_CASE("a process that is killed again and again while it saves loses at most the step in hand") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path(), false);
  fs::remove(dir.file("cap_boy.joints.json"));  // whose joints are others
  const std::string label_path = dir.file("cap_boy.labels.json");
  Rng rng(1);
  int step = 0;
  for (int round = 0; round < 40; ++round) {
    const int reported = saveUntilKilled(dir.path(), step, rng);
    finishSave(label_path);
    CHECK(findProblems(label_path).empty());
    const int saved = savedStep(readLabelFile(label_path));
    CHECK(saved >= reported);
    CHECK(saved <= reported + 1);
    step = saved + 1;
  }
  CHECK(checkLabels(dir.path(), {loadTemplate("biped")}).empty());
}

TEST_CASE("a process that is killed while it edits a motion loses at most the step in hand") {
  const TempDir dir;
  const SkeletonTemplate plan = loadTemplate("biped");
  copyCharacter("cap_boy", dir.path(), false);
  MotionFile motion;
  motion.frame_rate = 12;
  for (int f = 0; f < 40; ++f)
    motion.frames.push_back(
        {"cap_boy.png", 600, 600, f / 12.0, std::vector<std::optional<PlacedJoint>>(plan.joints.size())});
  const std::string path = dir.file("walk.motion.json");
  writeFile(path, formatMotionFile(motion, plan));
  Rng rng(2);
  int step = 0;
  for (int round = 0; round < 15; ++round) {
    const int reported = saveUntilKilled(path, step, rng);
    const MotionFile saved = readMotionFile(path, plan);
    // The steps go through the frames; the last one is the largest that is there.
    int last = -1;
    for (const MotionFrame& frame : saved.frames)
      if (const auto& head = frame.joints[static_cast<size_t>(plan.find("head"))])
        last = std::max(last, static_cast<int>(head->image.x()) + 500 * static_cast<int>(head->image.y()));
    CHECK(last >= reported);
    CHECK(last <= reported + 1);
    step = last + 1;
  }
  int temporary = 0;
  for (const auto& entry : fs::directory_iterator(dir.path()))
    temporary += entry.path().string().ends_with(".skel-tmp");
  CHECK(temporary <= 2);  // one a file, taken over by the next save
}

TEST_CASE("a save that ended anywhere between label file and mask is taken to one of its ends") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  const std::string label_path = dir.file("cap_boy.labels.json"), mask = dir.file("cap_boy.mask.png");
  {
    Document document(dir.path(), documentOptions());
    document.label({0}, JointClass::kHead);
  }
  const std::string old_labels = readFile(label_path), old_mask = readFile(mask);
  {
    Document document(dir.path(), documentOptions());
    document.paintMask({300, 300}, {300, 300}, 20, false);
    document.paintMask({20, 20}, {40, 40}, 5, true);
  }
  const std::string new_labels = readFile(label_path), new_mask = readFile(mask);
  REQUIRE(old_mask != new_mask);
  REQUIRE(old_labels != new_labels);

  // Died after the new mask was written beside the old one: the step has not happened.
  writeFile(label_path, old_labels);
  writeFile(mask, old_mask);
  writeFile(mask + ".next", new_mask);
  finishSave(label_path);
  CHECK(readFile(mask) == old_mask);
  CHECK_FALSE(fs::exists(mask + ".next"));
  CHECK(findProblems(label_path).empty());

  // Died after the label file was replaced: it has.
  writeFile(label_path, new_labels);
  writeFile(mask + ".next", new_mask);
  CHECK_FALSE(findProblems(label_path).empty());
  finishSave(label_path);
  CHECK(readFile(mask) == new_mask);
  CHECK_FALSE(fs::exists(mask + ".next"));
  CHECK(findProblems(label_path).empty());
}
