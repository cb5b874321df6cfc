// What the plugin skel_imgcodecs exports. It is a library of its own because OpenCV's imgcodecs brings so
// many others along that linking it would cost 55 ms at every start of a program that needs a few.
#pragma once

#include <cstddef>
#include <cstdint>

#define SKEL_DECODE_NAME "skelDecode1"

// Decodes the first picture of a file to 8-bit RGBA. Returns 1 and hands over width×height×4 bytes, which the
// caller frees with free(); or returns 0 and says why in `message`.
using SkelDecode = int (*)(const std::uint8_t* bytes, std::size_t size, int* width, int* height,
                           std::uint8_t** rgba, char* message, std::size_t message_size);
