#include "libskel/video/video_reader.h"

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/draw/canvas.h"
#include "libskel/video/video_writer.h"
#include "tests/support/catch.h"
#include "tests/support/temp_dir.h"

using namespace skel;
using Catch::Matchers::Contains;

namespace {

std::vector<VideoFrame> all(const std::string& path) {
  const auto reader = readVideo(path, 10);
  std::vector<VideoFrame> frames;
  for (VideoFrame frame; reader->next(frame);) frames.push_back(frame);
  return frames;
}

std::string complaint(const std::string& path) {
  try {
    all(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("films come back frame by frame, with their times") {
  const TempDir dir;
  std::vector<std::string> names = {"frames/"};
#ifdef SKEL_VIDEO_MP4
  names.push_back("film.mp4");
#ifdef SKEL_VIDEO_GIF
  names.push_back("film.gif");
#endif
#endif
#ifdef SKEL_VIDEO_WEBP
  names.push_back("film.webp");
#endif
  for (const std::string& name : names) {
    CAPTURE(name);
    const auto video = openVideo(dir.file(name), {.width = 64, .height = 48, .frame_rate = 10});
    for (int f = 0; f < 12; ++f) {
      Image image = blankImage(64, 48);
      drawDisc(image, {8. + 4 * f, 24}, 6, {200, 30, 60});
      video->add(image);
    }
    video->finish();
    const std::vector<VideoFrame> frames = all(dir.file(name));
    REQUIRE(frames.size() == 12);
    for (int f = 0; f < 12; ++f) {
      const Image& image = frames[std::size_t(f)].image;
      REQUIRE(image.width == 64);
      CHECK(frames[std::size_t(f)].time_s == Approx(f / 10.).margin(0.011));
      CHECK(int(image.pixel(8 + 4 * f, 24)[1]) < 90);
      CHECK(int(image.pixel(63 - 4 * f, 3)[1]) > 200);
    }
  }
}

#if defined(SKEL_VIDEO_MP4) && defined(SKEL_VIDEO_GIF)
TEST_CASE("a transparent GIF stays transparent") {
  const TempDir dir;
  const auto video =
      openVideo(dir.file("a.gif"), {.width = 32, .height = 32, .frame_rate = 10, .transparent = true});
  for (int f = 0; f < 3; ++f) {
    Image image = blankImage(32, 32, kClear);
    drawDisc(image, {8. + 6 * f, 16}, 5, {10, 90, 60});
    video->add(image);
  }
  video->finish();
  for (const VideoFrame& frame : all(dir.file("a.gif"))) {
    CHECK(frame.image.pixel(0, 0)[3] == 0);
    CHECK((frame.image.rgba.col(3) == 255).count() > 50);
  }
}
#endif

TEST_CASE("a film whose header claims too many pixels, or 16x65535, is refused before they are made") {
  const TempDir dir;
  const struct {
    std::string name;
    std::size_t size_at;
    std::string size;  // as its header says it
    std::string said;
  } films[] = {
#if defined(SKEL_VIDEO_MP4) && defined(SKEL_VIDEO_GIF)
    {"a.gif", 6, "\xe0\x2e\xe0\x2e", "12000x12000"},
    // Longer than what turns and bends pictures can count: an abort.
    {"a.gif", 6, std::string("\x10\0\xff\xff", 4), "16x65535"},
#endif
#ifdef SKEL_VIDEO_WEBP
    {"a.webp", 24, std::string("\xdf\x2e\0\xdf\x2e\0", 6), "12000x12000"},
#endif
    {"", 0, "", ""}
  };
  for (const auto& film : films) {
    if (film.name.empty()) continue;
    CAPTURE(film.name);
    const auto video = openVideo(dir.file(film.name), {.width = 32, .height = 32, .frame_rate = 10});
    for (int f = 0; f < 3; ++f) {
      Image image = blankImage(32, 32);
      drawDisc(image, {8. + 6 * f, 16}, 5, {10, 90, 60});
      video->add(image);
    }
    video->finish();
    std::string bytes = readFile(dir.file(film.name));
    bytes.replace(film.size_at, film.size.size(), film.size);
    writeFile(dir.file(film.name), bytes);
    CHECK_THAT(complaint(dir.file(film.name)), Contains(film.name + ": is too large: " + film.said));
  }
}

TEST_CASE("a film of large frames is read smaller") {
  const TempDir dir;
  const std::vector<std::string> names = {
#ifdef SKEL_VIDEO_MP4
      "a.mp4",
#endif
#ifdef SKEL_VIDEO_WEBP
      "a.webp",
#endif
  };
  for (const std::string& name : names) {
    CAPTURE(name);
    const auto video = openVideo(dir.file(name), {.width = 2400, .height = 1200, .frame_rate = 10});
    Image image = blankImage(2400, 1200);
    drawDisc(image, {1200, 600}, 300, {10, 90, 60});
    video->add(image);
    video->finish();
    VideoFrame frame;
    REQUIRE(readVideo(dir.file(name))->next(frame));
    CHECK(frame.image.width == 1200);
    CHECK(frame.image.height == 600);
    CHECK(int(frame.image.pixel(600, 300)[1]) - int(frame.image.pixel(600, 300)[0]) > 60);
    CHECK(int(frame.image.pixel(600, 130)[0]) > 240);
  }
}

TEST_CASE("what is no film is refused by name") {
  const TempDir dir;
  writeFile(dir.file("text.mp4"), "no film at all");
  writeFile(dir.file("empty/readme.txt"), "nothing");
  CHECK_THAT(complaint(dir.file("none.mp4")), Contains("none.mp4: does not exist"));
  CHECK_THAT(complaint(dir.file("empty")), Contains("holds no pictures"));
#ifdef SKEL_VIDEO_MP4
  CHECK_THAT(complaint(dir.file("text.mp4")), Contains("text.mp4: cannot be read as a film"));
#endif
#ifdef SKEL_VIDEO_WEBP
  for (const char* bytes : {"", "RIFF", "RIFF....WEBPVP8X"}) {
    writeFile(dir.file("a.webp"), bytes);
    CHECK_THAT(complaint(dir.file("a.webp")), Contains("a.webp: "));
  }
#endif
}
