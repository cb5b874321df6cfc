// Run in a child process each: the guard stays on for good.
#include "libskel/core/input_guard.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <thread>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "tests/support/catch.h"
#include "tests/support/temp_dir.h"

using namespace skel;
namespace fs = std::filesystem;

namespace {

// What `work` is refused with under the guard, "": nothing.
std::string refusal(const std::function<void()>& work) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    std::string message;
    try {
      guardInputs();
      work();
    } catch (const UsageError& error) {
      message = error.what();
    } catch (const std::exception& error) {
      message = std::string("another error: ") + error.what();
    }
    (void)!write(ends[1], message.data(), message.size());
    _exit(0);
  }
  close(ends[1]);
  std::string message;
  char block[4096];
  for (ssize_t count; (count = read(ends[0], block, sizeof block)) > 0;)
    message.append(block, static_cast<size_t>(count));
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return message;
}

}  // namespace

TEST_CASE("what was read is not written over, by whatever name") {
  const TempDir dir;
  const std::string in = dir.file("in"), link = dir.file("link"), twin = dir.file("twin");
  writeFile(in, "precious");
  fs::create_symlink("in", link);
  fs::create_hard_link(in, twin);
  for (const std::string& out : {in, dir.file("./in"), link, twin}) {
    CAPTURE(out);
    const std::string message = out + " would be written over, but it is an input" +
                                (out == in ? "" : " (" + in + ")") + "; name another output";
    CHECK(refusal([&] { readFile(in), writeFile(out, "lost"); }) == message);
    CHECK(refusal([&] { readFile(in), noteOutput(out); }) == message);
    CHECK(refusal([&] { noteOutput(out), readFile(in); }) == message);
    CHECK(refusal([&] { noteNamedOutput(out), noteInput(in); }) == message);
    CHECK(readFile(in) == "precious");
  }
}

TEST_CASE("an output that was read was written over by whoever went on after the refusal to read it") {
  const TempDir dir;
  writeFile(dir.file("a"), "before");
  CHECK(refusal([&] {
          noteNamedOutput(dir.file("a"));
          CHECK_THROWS_AS(readFile(dir.file("a")), OverwriteError);
          writeFile(dir.file("a"), "after");
        }) != "");
  CHECK(readFile(dir.file("a")) == "before");
}

TEST_CASE("a document is edited in place, and what was looked at only is replaced") {
  const TempDir dir;
  const std::string path = dir.file("x");
  writeFile(path, "1");
  CHECK(refusal([&] {
          readFile(path), replaceFile(path, "2");
          readFile(path), writeFile(path, "3");  // its own by now
        }).empty());
  CHECK(readFile(path) == "3");
  CHECK(refusal([&] {
          {
            const LookAtOutputs look;
            readFile(path);
          }
          writeFile(path, "4");
        }).empty());
  CHECK(readFile(path) == "4");
}

TEST_CASE("what a program has written it reads and writes again, whatever number the file gets") {
  const TempDir dir;
  CHECK(refusal([&] {
          for (int i = 0; i < 50; ++i) {
            const std::string path = dir.file(std::to_string(i % 3));
            noteOutput(path);
            writeFile(path, std::to_string(i));
            readFile(path);
          }
        }).empty());
}

TEST_CASE("two outputs that are one file are refused, folders and devices are not") {
  const TempDir dir;
  fs::create_directories(dir.file("a"));
  CHECK(refusal([&] { noteNamedOutput(dir.file("x")), noteNamedOutput(dir.file("a/../x")); }) ==
        dir.file("a/../x") + " is to be written twice, also as " + dir.file("x") +
            "; name two different outputs");
  CHECK(refusal([&] { noteNamedOutput(dir.file("a")), noteNamedOutput(dir.file("a")); }).empty());
  CHECK(refusal([&] { noteNamedOutput("/dev/null"), noteNamedOutput("/dev/null"); }).empty());
  CHECK(refusal([&] { noteNamedOutput("-"); }) ==
        "- is the name of no output; /dev/stdout is the standard output");
}

TEST_CASE("a pipe is opened where it was named, and not where a folder or a file leads to it") {
  const TempDir dir;
  const std::string pipe = dir.file("pipe"), link = dir.file("link");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  fs::create_symlink("pipe", link);
  for (const std::string& path : {pipe, link}) {
    CHECK(refusal([&] { readFile(path); }) ==
          "another error: " + path +
              ": is a pipe, not a file; pipes are read where the command line names them");
    CHECK(refusal([&] { writeFile(path, "x"); }) ==
          "another error: " + path + ": cannot be replaced: it is a pipe");
  }
  CHECK(refusal([&] {
          notePipe(link);
          std::thread writer([&] { writeFile(pipe, "bytes"); });
          if (readFile(pipe) != "bytes") throw UsageError("other bytes");
          writer.join();
        }).empty());
}

TEST_CASE("what is noted for now is guarded meanwhile, and forgotten at the end") {
  const TempDir dir;
  const std::string in = dir.file("in"), shared = dir.file("shared");
  writeFile(in, "precious");
  writeFile(shared, "of all");
  CHECK(refusal([&] {
          const NotedForNow now;
          readFile(in), writeFile(in, "lost");
        }).starts_with(in + " would be written over"));
  CHECK(refusal([&] {
          readFile(shared);
          for (int i = 0; i < 20; ++i) {
            const NotedForNow now;
            readFile(in);
            readFile(shared);
            noteOutput(dir.file("out"));
            writeFile(dir.file("out"), "made");
          }
          if (notedFiles() != 1) throw UsageError(std::to_string(notedFiles()) + " are still noted");
          writeFile(in, "another's by now");
          writeFile(shared, "lost");
        }).starts_with(shared + " would be written over"));
  CHECK(readFile(shared) == "of all");
}
