// The index of a database of motions.
#include "stylizer/database.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  mayRefuse([&] {
    const std::string index = fileOf(textOf(data, size), kDatabaseIndex);
    const std::string dir = index.substr(0, index.rfind('/'));
    for (const DatabaseEntry& entry : readDatabase(dir))
      require(entry.file.find('/') == std::string::npos, "motions lie in the folder itself");
    checkDatabase(dir);
  });
  return 0;
}
