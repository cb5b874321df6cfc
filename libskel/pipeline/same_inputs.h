// Whether what a drawing is rigged from is the same, to the last bit.
#pragma once

#include <optional>
#include <vector>

#include "libskel/pipeline/rig_character.h"
#include "libskel/pipeline/rig_memory.h"

namespace skel {

bool same(const Image& a, const Image& b);
bool same(const Plane8& a, const Plane8& b);
bool same(const NamedPicture& a, const NamedPicture& b);
bool same(const Skeleton& a, const Skeleton& b);
template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b) {
  return a && b ? same(*a, *b) : !a && !b;
}

// What differs.
std::vector<RigPart> changes(const RigOptions& from, const RigOptions& to);

}  // namespace skel
