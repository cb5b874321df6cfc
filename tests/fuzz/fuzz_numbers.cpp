// What is typed behind number options of every kind.
#include "libskel/cli/number.h"

#include <cmath>
#include <optional>

#include "tests/fuzz/fuzz.h"

namespace skel {
namespace {

// Whatever `check` lets pass lies in [low, high].
template <class Number>
void read(const std::string& text, const CLI::Validator& check, Number low, Number high) {
  CLI::App app;
  std::optional<Number> number;
  std::vector<Number> list;
  app.add_option("--number", number)->check(check);
  app.add_option("--list", list)->check(check)->delimiter(',');
  requireNumberChecks(app);
  try {
    app.parse(std::vector<std::string>{"--list=" + text, "--number=" + text});
  } catch (const CLI::ParseError&) {
    return;
  }
  if (number) list.push_back(*number);
  for (const Number n : list)
    require((n >= low && n <= high) || n == Number{}, "\"" + text + "\" is in no range that is asked for");
}

}  // namespace
}  // namespace skel

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  std::string text(textOf(data, size));
  text = text.substr(0, text.find('\0'));  // as arguments end
  read<double>(text, numberIn(-1., 1.), -1, 1);
  read<float>(text, zeroOrNumberIn(1e-3f, 64.f), 1e-3f, 64);
  read<int>(text, numberIn(-3, 1'000'000), -3, 1'000'000);
  read<unsigned>(text, numberIn(0u, 1000u), 0, 1000);
  read<std::uint64_t>(text, seedNumber(), 0, std::uint64_t{1} << 53);
  read<int>(text, oneOfNumbers({0, 90, 180, 270}), 0, 270);
  return 0;
}
