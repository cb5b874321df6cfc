// Names of files as JSON text. JSON is UTF-8, names are any bytes.
#pragma once

#include <string>
#include <string_view>

namespace skel {

// A name that is UTF-8 stays as it is. Every byte 0x80 + k that is not part of UTF-8 becomes the character
// U+EF80 + k, as in the OPTU-8 encoding of MirBSD, and so does every byte of those characters themselves: no
// two names give the same text, and fileNameFromJson() gives back the bytes.
std::string jsonFromFileName(std::string_view name);
std::string fileNameFromJson(std::string_view text);

}  // namespace skel
