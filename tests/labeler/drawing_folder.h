// Folders with a drawing or two, to be labelled.
#pragma once

#include <filesystem>
#include <string>

#include "labeler/document.h"
#include "libskel/classifier/weights_file.h"
#include "tests/support/temp_dir.h"

namespace skel {

inline const std::string kCharacters = SKEL_SOURCE_DIR "/datasets/characters/";

// Picture and joints of a character of the labelled set, with its mask or without.
inline void copyCharacter(const std::string& name, const std::string& folder, bool with_mask = true) {
  std::filesystem::create_directories(folder);
  for (const char* ending : {".png", ".mask.png", ".joints.json"})
    if (with_mask || ending != std::string(".mask.png"))
      std::filesystem::copy(kCharacters + name + ending, folder + "/" + name + ending);
}

inline DocumentOptions documentOptions() { return {defaultMlp(), bodyPlans("biped")}; }

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace skel
