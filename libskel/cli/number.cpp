#include "libskel/cli/number.h"

#include "libskel/core/check.h"

namespace skel {
namespace {

bool hasNumberCheck(CLI::Option& option) {
  try {
    return option.get_validator(kNumberCheck) != nullptr;
  } catch (const CLI::OptionNotFound&) {
    return false;
  }
}

}  // namespace

void requireNumberChecks(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    const std::string described = option->get_type_name(), type = described.substr(0, described.find(':'));
    const bool number =
        option->get_items_expected_max() > 0 && (type == "FLOAT" || type == "INT" || type == "UINT");
    if (number && !hasNumberCheck(*option))
      checkFailed(__FILE__, __LINE__,
                  app.get_name() + ": " + option->get_name() + " takes any number; say which");
  }
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) requireNumberChecks(*command);
}

}  // namespace skel
