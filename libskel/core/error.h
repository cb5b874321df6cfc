// What can go wrong with a user's data or machine, as exceptions that a tool turns into one line and an exit
// code.
#pragma once

#include <stdexcept>
#include <string>

namespace skel {

enum class ExitCode { kDone = 0, kUsage = 1, kInput = 2, kUnavailable = 3, kOutput = 4 };

// what() is the whole line for the user, a messageLine(): which file, where in it, what is wrong, what to do.
class Error : public std::runtime_error {
 public:
  Error(ExitCode exit_code, const std::string& message);
  ExitCode exitCode() const { return exit_code_; }

 private:
  ExitCode exit_code_;
};

// The command line asks for something that makes no sense.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ExitCode::kUsage, message) {}
};

// A file that cannot be used. what() starts with its path.
class InputError : public Error {
 public:
  InputError(const std::string& file, const std::string& problem);
  const std::string& file() const { return file_; }
  // Without the file's name.
  const std::string& problem() const { return problem_; }

 private:
  std::string file_;
  std::string problem_;
};

// Something that this machine or this build lacks: a display, a codec, a plugin.
class UnavailableError : public Error {
 public:
  explicit UnavailableError(const std::string& message) : Error(ExitCode::kUnavailable, message) {}
};

// A file that could not be written. what() starts with its path.
class OutputError : public Error {
 public:
  OutputError(const std::string& file, const std::string& problem);
};

}  // namespace skel
