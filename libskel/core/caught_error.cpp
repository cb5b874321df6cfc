#include "libskel/core/caught_error.h"

#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <system_error>

#include "libskel/core/text.h"

namespace skel {
namespace {

std::string oneLine(const char* text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

Error refusal(const std::string& start, const std::string& why) {
  return {ExitCode::kUnavailable, start + "the system refuses what is needed: " + why};
}

}  // namespace

Error caughtError(const std::string& source) {
  const std::string start = source.empty() ? "" : source + ": ";
  const Error no_memory(ExitCode::kUnavailable, start + "needs more memory than there is");
  try {
    throw;
  } catch (const Error& error) {
    return error;
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string path = error.path1().string();
    return InputError(path.empty() ? source : path, "cannot be looked at: " + error.code().message());
  } catch (const std::bad_alloc&) {
    return no_memory;
  } catch (const std::length_error&) {
    return no_memory;
  } catch (const std::system_error& error) {
    return refusal(start, error.code().message());
  } catch (const std::exception& error) {
    // OpenCV and its threads, whose types this room does not know, say it in words.
    const std::string what = oneLine(error.what());
    if (what.find("(-4:Insufficient memory)") != std::string::npos) return no_memory;
    const std::string no_thread = std::make_error_code(std::errc::resource_unavailable_try_again).message();
    if (what.ends_with(": " + no_thread)) return refusal(start, no_thread);
    return Error(ExitCode::kInput, start + "cannot be worked on, please report it: " + what);
  } catch (...) {
    return Error(ExitCode::kInput, start + "cannot be worked on, please report it");
  }
}

}  // namespace skel
