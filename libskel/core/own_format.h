// Files of skel's own formats, told apart by what stands at their beginning: {"format": "skel-labels", ...
#pragma once

#include <string>
#include <string_view>

namespace skel {

// The format of the file that begins with these bytes; empty: none of skel's.
std::string ownFormatOf(std::string_view bytes);

// Before a file of `format` (empty: of none of skel's) is written to `path`: throws OutputError where a file
// of another of skel's formats lies, which somebody may have worked on.
void keepOtherFormats(const std::string& path, std::string_view format);

}  // namespace skel
