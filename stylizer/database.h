// A folder of motion files with an index.
#pragma once

#include <string>
#include <vector>

#include "libskel/skeleton/motion_file.h"

namespace skel {

inline constexpr const char* kDatabaseIndex = "index.json";

struct DatabaseEntry {
  std::string file;    // of the motion, in the folder
  std::string action;  // its class
  std::string source;
  int frames = 0, keys = 0;
  std::string sha256;  // of the file
};

// Reads `<dir>/index.json`. Throws InputError, also where there is none: the folder is no database.
std::vector<DatabaseEntry> readDatabase(const std::string& dir);

// Copies the motion into the folder, as `<name>` or under its own name, and writes the index anew. `action`:
// its class, if not what the file says. Throws InputError: no class, a motion of
// that name is there already (unless `force`); OutputError.
DatabaseEntry addToDatabase(const std::string& dir, const std::string& motion, const std::string& action,
                            bool force);

// What is wrong, one line each: motions that are missing, that have changed, that cannot be read, that stand
// in no index. Empty: nothing.
std::vector<std::string> checkDatabase(const std::string& dir);

// Throws InputError, of a film with what makes a motion of it.
MotionFile readMotion(const std::string& file);

// A motion file alone, or all of a database.
struct NamedMotion {
  std::string path;
  MotionFile motion;
};
std::vector<NamedMotion> readMotions(const std::string& file_or_database);

}  // namespace skel
