// Files of nets, told apart by what stands at their beginning.
#pragma once

#include <string>
#include <string_view>

namespace skel {

// What a net of that format is, for people; empty: no format of nets.
std::string netFormatName(std::string_view format);

// The format of the net that begins with these bytes; empty: no net.
std::string netFormatOf(std::string_view bytes);

// Throws InputError that names the kind if the file is another kind of net than `format` ("skel-joint-net").
// What is no net at all is left to the reader of the format.
void checkNetFormat(std::string_view bytes, const std::string& file, std::string_view format);

}  // namespace skel
