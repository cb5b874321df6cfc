// Of every command of every tool, as --help lists them: whatever names a file is an input that the command's
// outputs do not write over, unless it is one of them. Who adds a command says here what it writes.
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "tests/tools/tools.h"

using namespace skel;

namespace {

struct Word {
  std::string name;  // "--output"; of what stands without an option "DIR"
  std::string type;  // "TEXT", "INT:in [0 - 1024]"; of a flag ""
  bool positional = false, required = false;

  bool takesText() const {
    for (const char* other : {"INT", "UINT", "FLOAT", "Excludes:", "Needs:"})  // numbers and flags
      if (type.starts_with(other)) return false;
    return !type.empty() && type.find_first_of("{|") == type.npos;  // names to choose from
  }
  bool isList() const { return type.find(" ...") != type.npos || type.find(" x 2") != type.npos; }
  bool excludes(const Word& other) const {
    const std::size_t list = type.find("Excludes:");
    return list != type.npos && (type.substr(list) + " ").find(" " + other.name + " ") != type.npos;
  }
};

struct Command {
  std::string line;  // "skel-infer evaluate"
  std::vector<Word> words;
  std::vector<std::string> commands;
};

Word wordOf(const std::string& entry, bool positional) {
  std::istringstream in(entry);
  std::string names;
  Word word;
  word.positional = positional;
  in >> names;
  word.name = names.substr(names.rfind(',') == names.npos ? 0 : names.rfind(',') + 1);
  std::getline(in >> std::ws, word.type);
  // The type, REQUIRED and the description, with two blanks before that.
  word.type = word.type.substr(0, word.type.find("  "));
  if (!positional && entry.find(names + "  ") != entry.npos) word.type.clear();  // a flag
  word.required = word.type.find("REQUIRED") != word.type.npos;
  return word;
}

Command commandOf(const TempDir& dir, const std::string& line) {
  Command command{line, {}, {}};
  std::istringstream help(done(dir, line + " --help").out);
  std::string section;
  for (std::string text; std::getline(help, text);) {
    // Positionals, groups of options, subcommands.
    if (!text.empty() && text[0] != ' ') section = text.ends_with(':') ? text : "";
    if (text.size() < 3 || !text.starts_with("  ") || text[2] == ' ') continue;
    if (section == "Subcommands:")
      command.commands.push_back(text.substr(2, text.find(' ', 2) - 2));
    else if (!section.empty())
      command.words.push_back(wordOf(text.substr(2), section == "Positionals:"));
  }
  return command;
}

// All but its inputs that a command line names: files that it writes. Empty: it writes none, or into a
// folder, where writeFile() alone looks at each (inputs_kept_test.cpp).
const std::map<std::string, std::vector<std::string>> kOutputs = {
    {"skel-animate", {}},
    {"skel-animate info", {}},
    {"skel-animate list", {}},
    {"skel-animate bind", {"--output"}},
    {"skel-animate weights", {"--output"}},
    {"skel-animate retarget", {"--output"}},
    {"skel-animate render", {"--output", "--sheet"}},
    {"skel-animate view", {}},
    {"skel-infer", {"--report"}},
    {"skel-infer evaluate", {"--json"}},
    {"skel-label", {}},
    {"skel-label candidates", {}},
    {"skel-label import", {}},
    {"skel-label check", {}},
    {"skel-label stats", {}},
    {"skel-label motion", {"--output"}},
    {"skel-label export", {"--output"}},
    {"skel-style", {}},
    {"skel-style make", {"--output"}},
    {"skel-style keyframes", {}},
    {"skel-style keypoints", {"--output"}},
    {"skel-style database", {}},
    {"skel-style fit", {"--output"}},
    {"skel-style transfer", {"--output"}},
    {"skel-style render", {"--output", "--to-clip"}},
    {"skel-style inspect", {"--output"}},
    {"skel-train", {"--output", "--json"}},
    {"skel-train evaluate", {"--json"}},
    {"skel-train figures", {"--output"}},
    {"skel-train joints", {"--output", "--checkpoint"}},
    {"skel-train pages", {"--output", "--checkpoint", "--sheet"}},
    {"skel-train parts", {"--output", "--checkpoint", "--sheet", "--truth"}},
    {"skel-train average", {"--output"}},
    {"skel-train bones", {"--output"}},
    {"skel-train confidence", {"--output", "--table"}},
    {"skel-train silhouettes", {"--output"}},
    {"skel-train facing", {"--output"}},
    {"skel-train limbs", {"--output"}},
    {"skel-train loops", {"--output"}},
};

std::string given(const Word& word, const std::string& value) {
  return word.positional ? " " + value : " " + word.name + " " + value;
}

// The command with `input` and `output` naming one file.
std::string callOf(const Command& command, const Word& input, const Word& output) {
  std::string call = command.line;
  // Positionals last, and in their order: one before the input needs a word as well.
  bool before = true;
  for (const bool positional : {false, true})
    for (const Word& word : command.words) {
      if (word.positional != positional) continue;
      if (word.name == input.name || word.name == output.name)
        call += given(word, word.isList() ? "kept other" : "kept"),
            before = before && word.name != input.name;
      else if (word.required || (positional && input.positional && before))
        call += given(word, "other");
    }
  return call;
}

}  // namespace

TEST_CASE("every file that a command line names is an input, but for those that the command writes") {
  const TempDir dir;
  writeFile(dir.file("kept"), "precious");
  std::size_t known = 0, pairs = 0;
  for (const std::string tool : {"skel-animate", "skel-infer", "skel-label", "skel-style", "skel-train"}) {
    std::vector<std::string> lines{tool};
    for (const std::string& name : commandOf(dir, tool).commands) lines.push_back(tool + " " + name);
    for (const std::string& line : lines) {
      const auto outputs = kOutputs.find(line);
      if (outputs == kOutputs.end()) FAIL(line << " is a command that kOutputs of this test does not know");
      ++known;
      const Command command = commandOf(dir, line);
      for (const std::string& name : outputs->second) {
        const auto output = std::find_if(command.words.begin(), command.words.end(),
                                         [&](const Word& word) { return word.name == name; });
        if (output == command.words.end()) FAIL(line << " has no " << name);
        for (const Word& input : command.words) {
          if (!input.takesText() || input.name == name || input.excludes(*output)) continue;
          // These go with a sheet alone, which may be the same, made anew.
          if (input.name == "--like" || input.name == "--palette") continue;
          const std::string call = callOf(command, input, *output);
          const bool both = std::count(outputs->second.begin(), outputs->second.end(), input.name) > 0;
          refused(dir, call, 1,
                  both ? "is to be written twice" : "would be written over, but it is an input");
          ++pairs;
        }
      }
    }
  }
  CHECK(known == kOutputs.size());
  CHECK(pairs > 100);
  CHECK(filesBelow(dir.path()).size() == 1);
  CHECK(readFile(dir.file("kept")) == "precious");
}
