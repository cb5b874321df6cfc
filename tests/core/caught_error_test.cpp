#include "libskel/core/caught_error.h"

#include <filesystem>
#include <future>
#include <new>
#include <system_error>

#include "libskel/core/text.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

// "code: line"
template <class Throw>
std::string caught(const Throw& work) {
  try {
    work();
  } catch (...) {
    const Error error = caughtError("a.png");
    return std::to_string(static_cast<int>(error.exitCode())) + ": " + error.what();
  }
  return "nothing";
}

}  // namespace

TEST_CASE("whatever is thrown becomes one line that names the input, and a code") {
  CHECK(caught([] { throw OutputError("b.glb", "is full"); }) == "4: b.glb: is full");
  CHECK(caught([] { throw std::bad_alloc(); }) == "3: a.png: needs more memory than there is");
  CHECK(caught([] { std::vector<int>().resize(std::size_t(-1)); }) ==
        "3: a.png: needs more memory than there is");
  CHECK(caught([] {
          throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
        }) == "3: a.png: the system refuses what is needed: Resource temporarily unavailable");
  CHECK(caught([] {
          throw std::filesystem::filesystem_error("stat", "dir/c",
                                                  std::make_error_code(std::errc::filename_too_long));
        }) == "2: dir/c: cannot be looked at: File name too long");
  CHECK(caught([] {
          throw std::runtime_error("OpenCV(4.6.0) alloc.cpp:73: error: (-4:Insufficient memory)\n x");
        }) == "3: a.png: needs more memory than there is");
  CHECK(caught([] {
          throw std::runtime_error("pthread_create has failed: Resource temporarily unavailable");
        }) == "3: a.png: the system refuses what is needed: Resource temporarily unavailable");
  CHECK(caught([] { throw std::runtime_error("two\nlines\n"); }) ==
        "2: a.png: cannot be worked on, please report it: two lines");
  CHECK(caught([] { throw 1; }) == "2: a.png: cannot be worked on, please report it");
}

TEST_CASE("a name in a file that holds a line of ours, or commands for a terminal, stays within its line") {
  CHECK(caught([] { throw InputError("c.json", "is \"a\nskel-infer: b\x1b[31m\x07\""); }) ==
        "2: c.json: is \"a\\nskel-infer: b\\x1b[31m\\x07\"");
}

TEST_CASE("a value of any length leaves the file, the place and what to do in a message") {
  for (const std::string letter : {"x", "ä", "走"}) {
    std::string value;
    while (value.size() < 3'000'000) value += letter;
    const std::string said =
        InputError("a.obj", "line 7: '" + value + "' is no number; export it anew").what();
    CHECK(said.size() < 610);
    CHECK(said.starts_with("a.obj: line 7: '" + letter));
    CHECK(said.ends_with(letter + "' is no number; export it anew"));
    CHECK(printable(said) == said);
  }
}

TEST_CASE("a zero byte in a name does not end the complaint about it") {
  const InputError error("c.json", std::string("names \"a\0b\", which is no joint", 30));
  CHECK(std::string(error.what()) == "c.json: names \"a\\x00b\", which is no joint");
}

TEST_CASE(
    "what people are shown keeps letters of all languages, and nothing that commands a terminal or turns "
    "text around") {
  CHECK(printable("Bär 走 🦌") == "Bär 走 🦌");
  CHECK(printable("\t\r\x7f\x1b[2J\n") == "\\x09\\x0d\\x7f\\x1b[2J\\n");
  CHECK(printable("\xc2\x9b[2J") == "\\x9b[2J");
  // A surrogate, overlong forms and what lies beyond Unicode are bytes.
  CHECK(printable("\xed\xa0\x80") == "\\xed\\xa0\\x80");
  CHECK(printable("\xe0\x82\x9b") == "\\xe0\\x82\\x9b");
  CHECK(printable("\xf0\x80\x82\x9b") == "\\xf0\\x80\\x82\\x9b");
  CHECK(printable("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");
  CHECK(printable("a\u202eb\u2066c\u2028d\u2029e\u061cf\u200fg") ==
        "a\\u202eb\\u2066c\\u2028d\\u2029e\\u061cf\\u200fg");
  CHECK(printable("\x9b[2J\xe4\xf0\x9f\xa6") == "\\x9b[2J\\xe4\\xf0\\x9f\\xa6");
}
