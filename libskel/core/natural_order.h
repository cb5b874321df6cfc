// Names in the order in which people read them.
#pragma once

#include <string>

namespace skel {

// Numbers in names count as numbers, and Latin letters without their marks, small or capital: "a9" before
// "a10", "neu" before "Zoe", "Ömer" (in UTF-8, composed or not) between "Olga" and "Otto".
bool comesBefore(const std::string& a, const std::string& b);

// "Ömer" as "Omer". What is no Latin letter stays.
std::string withoutMarks(const std::string& text);

}  // namespace skel
