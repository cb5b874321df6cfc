#include "libskel/core/net_format.h"

#include <array>
#include <utility>

#include "libskel/core/error.h"
#include "libskel/core/own_format.h"

namespace skel {

std::string netFormatName(std::string_view format) {
  constexpr std::string_view kCheckpoint =
      "a checkpoint (the line of skel-train that wrote it, run to its end, makes a net of it)";
  constexpr std::array<std::pair<std::string_view, std::string_view>, 11> kKinds = {
      {{"skel-confidence", "numbers that say how sure the recognition is"},
       {"skel-silhouette-confidence", "numbers that say how sure a silhouette is"},
       {"skel-loop-net", "a net that tells what is ground within lines"},
       {"skel-limb-net", "a net that tells whether a limb is one"},
       {"skel-facing-net", "a net that tells which way a figure looks"},
       {"skel-weights", "weights that tell candidates apart (--weights)"},
       {"skel-joint-net", "a net that finds joints (--joint-net)"},
       {"skel-part-net", "a net that tells parts (--part-net)"},
       {"skel-page-net", "a net that finds figures on pages"},
       {"skel-training", kCheckpoint},
       {"skel-checkpoint", kCheckpoint}}};  // of former versions, by themselves
  for (const auto& [kind, name] : kKinds)
    if (kind == format) return std::string(name);
  return {};
}

std::string netFormatOf(std::string_view bytes) {
  const std::string found = ownFormatOf(bytes);
  return netFormatName(found).empty() ? std::string() : found;
}

void checkNetFormat(std::string_view bytes, const std::string& file, std::string_view format) {
  const std::string found = netFormatOf(bytes);
  if (!found.empty() && found != format)
    throw InputError(file, "is " + netFormatName(found) + "; " + netFormatName(format) + " was expected");
}

}  // namespace skel
