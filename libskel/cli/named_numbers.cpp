#include "libskel/cli/named_numbers.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "libskel/cli/names.h"
#include "libskel/cli/number.h"
#include "libskel/core/error.h"

namespace skel {
namespace {

struct Word {
  std::string name, number;  // without a name it is of all

  explicit Word(const std::string& text) {
    const std::size_t equals = text.rfind('=');
    if (equals != text.npos) name = text.substr(0, equals);
    number = equals == text.npos ? text : text.substr(equals + 1);
  }
};

}  // namespace

CLI::Option* addNamedNumbers(CLI::App& app, const std::string& option, NamedNumbers& numbers,
                             const CLI::Validator& check, const std::string& description) {
  const auto take = [&numbers](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const Word word(text);
      double& number = word.name.empty() ? numbers.of_others : numbers.of[word.name];
      CLI::detail::lexical_cast(word.number, number);
    }
  };
  const auto isNumber = [check](const std::string& text) {
    if (text.starts_with('=')) return "\"" + text + "\" names no file before =";
    std::string number = Word(text).number;
    return check(number);
  };
  return app.add_option_function<std::vector<std::string>>(option, take, description)
      ->delimiter(',')
      ->transform(withoutBlanks())
      ->check(CLI::Validator(isNumber, "", kNumberCheck))
      ->allow_extra_args(false)
      ->type_name("FLOAT,NAME=FLOAT");
}

void requireNamed(const NamedNumbers& numbers, const std::string& option,
                  const std::vector<std::string>& files) {
  for (const auto& [name, number] : numbers.of)
    if (std::none_of(files.begin(), files.end(), [&name = name](const std::string& file) {
          return std::filesystem::path(file).stem() == name;
        }))
      throw UsageError(option + ": no file of this run is called \"" + name + '"');
}

}  // namespace skel
