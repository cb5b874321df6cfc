#include "libskel/video/video_writer.h"

#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/read_image.h"
#include "libskel/video/formats.h"
#include "tests/support/catch.h"
#include "tests/support/temp_dir.h"

#ifdef SKEL_VIDEO_GIF
#include <gif_lib.h>
#endif

using namespace skel;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> formats() {
  std::vector<std::string> names = {"frames/"};
#ifdef SKEL_VIDEO_MP4
  names.push_back("film.mp4");
#endif
#ifdef SKEL_VIDEO_GIF
  names.push_back("film.gif");
#endif
#ifdef SKEL_VIDEO_WEBP
  names.push_back("film.webp");
#endif
  return names;
}

// A disc that goes from left to right.
Image frame(int number, const VideoOptions& options, Color background = kWhite) {
  Image image = blankImage(options.width, options.height, background);
  drawDisc(image, {8.0 + 3 * number, options.height / 2.0}, 6, {200, 30, 60});
  return image;
}

void write(const std::string& path, const VideoOptions& options, int frames = 12) {
  const auto video = openVideo(path, options);
  for (int i = 0; i < frames; ++i) video->add(frame(i, options, options.transparent ? kClear : kWhite));
  video->finish();
}

// All bytes of a film, or of all frames of a folder.
std::string bytesOf(const std::string& path) {
  if (!fs::is_directory(path)) return readFile(path);
  std::string bytes;
  for (const std::string& file : filesBelow(path)) bytes += file.substr(file.rfind('/')) + readFile(file);
  return bytes;
}

}  // namespace

TEST_CASE("the same frames give the same bytes, in every format") {
  const TempDir dir;
  for (const std::string& name : formats()) {
    CAPTURE(name);
    const VideoOptions options{.width = 64, .height = 48, .frame_rate = 24};
    fs::create_directories(dir.file("a"));
    write(dir.file("a/" + name), options);
    const std::string once = bytesOf(dir.file("a/" + name));
    CHECK(once.size() > 200);
    write(dir.file("a/" + name), options);  // over the old one
    CHECK(bytesOf(dir.file("a/" + name)) == once);
    write(dir.file("new/folder/" + name), options);
    CHECK(bytesOf(dir.file("new/folder/" + name)) == once);
  }
}

TEST_CASE("a small film that is written twenty times has the same bytes, whatever lies in free memory") {
  const TempDir dir;
  for (const std::string& name : formats()) {
    CAPTURE(name);
    const VideoOptions options{.width = 64, .height = 48, .frame_rate = 24};
    std::string once;
    for (int time = 0; time < 20; ++time) {
      {
        std::vector<std::string> dirt;
        for (std::size_t bytes = 64; bytes < 2'000'000; bytes += bytes / 3)
          dirt.emplace_back(bytes, static_cast<char>(37 * time + 1));
      }
      write(dir.file(name), options);
      if (time == 0) once = bytesOf(dir.file(name));
      REQUIRE(bytesOf(dir.file(name)) == once);
    }
  }
}

TEST_CASE("a folder of frames holds the frames") {
  const TempDir dir;
  const VideoOptions options{.width = 33, .height = 21, .frame_rate = 24, .frames = 3, .transparent = true};
  write(dir.file("frames"), options, 3);
  CHECK(filesBelow(dir.file("frames")).size() == 3);
  CHECK((readImage(dir.file("frames/frame-0002.png")).rgba.col(3) == frame(1, options, kClear).rgba.col(3))
            .all());

  VideoOptions shorter = options;
  shorter.frames = 2;
  CHECK_THROWS_WITH(openVideo(dir.file("frames"), shorter),
                    Catch::Matchers::Contains("frame-0003.png: belongs to another film; remove it"));
}

TEST_CASE("of the frames that a longer film had left in a folder only the first was named") {
  const TempDir dir;
  VideoOptions options{.width = 33, .height = 21, .frame_rate = 24, .frames = 12};
  write(dir.file("my frames"), options, 12);
  options.frames = 8;
  CHECK_THROWS_WITH(openVideo(dir.file("my frames"), options),
                    Catch::Matchers::Contains("frame-0009.png: belongs to another film, as do 3 more up to "
                                              "frame-0012.png; remove them (rm '" +
                                              dir.file("my frames/frame-") + "'{0009..0012}.png), or name"));
  fs::remove(dir.file("my frames/frame-0010.png"));
  CHECK_THROWS_WITH(openVideo(dir.file("my frames"), options),
                    Catch::Matchers::Contains("as do 2 more up to frame-0012.png; remove them, or name"));
}

#ifdef SKEL_VIDEO_MP4
namespace {

std::uint32_t bigEndian(const std::string& bytes, size_t at) {
  std::uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

}  // namespace

TEST_CASE("an MP4 holds every frame, at its size and rate") {
  const TempDir dir;
  write(dir.file("film.mp4"), {.width = 64, .height = 48, .frame_rate = 24}, 17);
  const std::string bytes = readFile(dir.file("film.mp4"));
  CHECK(bytes.substr(4, 4) == "ftyp");
  const size_t sizes = bytes.find("stsz"), header = bytes.find("mdhd"), track = bytes.find("tkhd");
  REQUIRE(sizes != std::string::npos);
  CHECK(bigEndian(bytes, sizes + 12) == 17);
  CHECK(bigEndian(bytes, header + 20) * 24 == bigEndian(bytes, header + 16) * 17);
  CHECK(bigEndian(bytes, track + 80) >> 16 == 64);
  CHECK(bigEndian(bytes, track + 84) >> 16 == 48);
}

TEST_CASE("an MP4 of an odd size is refused, not cut") {
  const TempDir dir;
  CHECK_THROWS_WITH(openVideo(dir.file("film.mp4"), {.width = 481, .height = 361}),
                    Catch::Matchers::Contains("481x361 is not; take 482x362"));
  CHECK_THROWS_WITH(openVideo(dir.file("film.mp4"), {.width = 48, .height = 36, .transparent = true}),
                    Catch::Matchers::Contains("MP4 has no transparency"));
}

TEST_CASE("without H.264 there is MPEG-4, without both one line says so") {
  const TempDir dir;
  const VideoOptions options{.width = 64, .height = 48};
  const auto film = openMp4(dir.file("film.mp4"), options, {"no-such-encoder", "mpeg4"});
  film->add(frame(0, options));
  film->finish();
  CHECK(readFile(dir.file("film.mp4")).find("mp4v") != std::string::npos);
  try {
    openMp4(dir.file("none.mp4"), options, {"no-such-encoder", "nor-this"});
    FAIL("opened");
  } catch (const UnavailableError& error) {
    CHECK(std::string(error.what()).find("tried no-such-encoder, nor-this") != std::string::npos);
    CHECK(error.exitCode() == ExitCode::kUnavailable);
  }
  CHECK_FALSE(fs::exists(dir.file("none.mp4")));
}
#endif

#ifdef SKEL_VIDEO_GIF
namespace {

// The pictures that a viewer shows, one after the other, and how long in all, in 1/100 s.
struct Shown {
  std::vector<Image> frames;
  int ticks = 0;
};

Shown showGif(const std::string& path) {
  GifFileType* gif = DGifOpenFileName(path.c_str(), nullptr);
  REQUIRE(gif);
  REQUIRE(DGifSlurp(gif) == GIF_OK);
  Shown shown;
  Image canvas = blankImage(gif->SWidth, gif->SHeight, kClear);
  for (int i = 0; i < gif->ImageCount; ++i) {
    GraphicsControlBlock control;
    REQUIRE(DGifSavedExtensionToGCB(gif, i, &control) == GIF_OK);
    const SavedImage& saved = gif->SavedImages[i];
    const GifImageDesc& box = saved.ImageDesc;
    Image picture = canvas;
    for (int y = 0; y < box.Height; ++y)
      for (int x = 0; x < box.Width; ++x) {
        const int index = saved.RasterBits[y * box.Width + x];
        if (index == control.TransparentColor) continue;
        const GifColorType& c = box.ColorMap->Colors[index];
        std::uint8_t* p = picture.pixel(box.Left + x, box.Top + y);
        p[0] = c.Red, p[1] = c.Green, p[2] = c.Blue, p[3] = 255;
      }
    shown.frames.push_back(picture);
    shown.ticks += control.DelayTime;
    if (control.DisposalMode != DISPOSE_BACKGROUND) canvas = picture;
  }
  DGifCloseFile(gif, nullptr);
  return shown;
}

}  // namespace

TEST_CASE("a GIF shows every frame as it was, and takes as long") {
  const TempDir dir;
  for (const bool transparent : {false, true}) {
    CAPTURE(transparent);
    const VideoOptions options{.width = 64, .height = 31, .frame_rate = 24, .transparent = transparent};
    const auto video = openVideo(dir.file("film.gif"), options);
    std::vector<Image> frames;
    for (int i : {0, 1, 1, 2, 9}) frames.push_back(frame(i, options, transparent ? kClear : kWhite));
    if (transparent) frames.push_back(blankImage(64, 31, kClear));
    for (const Image& image : frames) video->add(image);
    video->finish();
    const Shown shown = showGif(dir.file("film.gif"));
    REQUIRE(shown.frames.size() == frames.size());
    CHECK(std::abs(shown.ticks - 100.0 / 24 * double(frames.size())) <= 0.5);
    for (size_t i = 0; i < frames.size(); ++i)
      for (int y = 0; y < 31; ++y)
        for (int x = 0; x < 64; ++x) {
          const std::uint8_t *a = frames[i].pixel(x, y), *b = shown.frames[i].pixel(x, y);
          CAPTURE(i, x, y);
          REQUIRE((a[3] >= 128) == (b[3] == 255));
          for (int k = 0; k < 3 && b[3] > 0; ++k) REQUIRE(std::abs(a[k] - b[k]) <= 8);
        }
  }
}

TEST_CASE("a GIF that viewers would play slowly is refused") {
  const TempDir dir;
  CHECK_THROWS_WITH(openVideo(dir.file("film.gif"), {.width = 8, .height = 8, .frame_rate = 60}),
                    Catch::Matchers::Contains("at most 50 frames a second"));
}
#endif

#ifdef SKEL_VIDEO_WEBP
TEST_CASE("a WebP takes as long as it should and plays for ever") {
  const TempDir dir;
  write(dir.file("film.webp"), {.width = 64, .height = 48, .frame_rate = 24, .transparent = true}, 12);
  const std::string bytes = readFile(dir.file("film.webp"));
  const auto number = [&](size_t at, size_t count) {
    int value = 0;
    for (size_t i = count; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
    return value;
  };
  CHECK(bytes.substr(0, 4) == "RIFF");
  CHECK(number(bytes.find("ANIM") + 12, 2) == 0);  // loops
  int duration_ms = 0, frames = 0;
  for (size_t at = bytes.find("ANMF"); at != std::string::npos; at = bytes.find("ANMF", at + 4)) {
    duration_ms += number(at + 8 + 12, 3);
    ++frames;
  }
  CHECK(frames == 12);
  CHECK(duration_ms == 500);
}
#endif

TEST_CASE("a film that cannot be is refused before anything is drawn") {
  const TempDir dir;
  CHECK_THROWS_WITH(openVideo(dir.file("film.avi"), {}),
                    Catch::Matchers::Contains("film.avi: films are written as .mp4"));
  CHECK_THROWS_WITH(openVideo("", {}), Catch::Matchers::Contains("name the film"));
  CHECK_THROWS_WITH(openVideo(dir.file("f/"), {.width = 0}), Catch::Matchers::Contains("a film of 0x512 px"));
  CHECK_THROWS_WITH(openVideo(dir.file("f/"), {.frame_rate = 0}),
                    Catch::Matchers::Contains("frames a second"));
  writeFile(dir.file("file"), "x");
  for (const std::string& name : formats())
    CHECK_THROWS_AS(openVideo(dir.file("file/below/" + name), {}), OutputError);
}

TEST_CASE("a disk that is full leaves the old film and nothing else") {
  const TempDir dir;
  struct Limit {
    explicit Limit(rlim_t bytes) {
      getrlimit(RLIMIT_FSIZE, &before);
      rlimit limit = before;
      limit.rlim_cur = bytes;
      setrlimit(RLIMIT_FSIZE, &limit);
      handler = std::signal(SIGXFSZ, SIG_IGN);
    }
    ~Limit() {
      setrlimit(RLIMIT_FSIZE, &before);
      std::signal(SIGXFSZ, handler);
    }
    rlimit before;
    void (*handler)(int);
  };
  for (const std::string& name : formats()) {
    CAPTURE(name);
    if (!name.ends_with('/')) writeFile(dir.file(name), "old");
    {
      const Limit limit(100);
      CHECK_THROWS_AS(write(dir.file(name), {.width = 64, .height = 48}), OutputError);
    }
    if (!name.ends_with('/')) CHECK(readFile(dir.file(name)) == "old");
  }
  CHECK(filesBelow(dir.path()).size() == formats().size() - 1);
}
