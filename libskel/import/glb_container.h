// The bytes behind a glTF document: chunks, buffer views, accessors.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/core/json.h"

namespace skel {

// A GLB file taken apart. `bytes` must outlive it. All throw InputError with the place in the document.
class GlbContainer {
 public:
  GlbContainer(std::string_view bytes, const std::string& file);

  JsonValue root() const { return document_.root(); }
  // The element of the document's list `list` ("nodes", "meshes" …) that `index` names.
  JsonValue element(std::string_view list, const JsonValue& index) const;
  int count(std::string_view list) const;

  // The bytes of a bufferView.
  std::string_view view(const JsonValue& index) const;

  // The numbers of an accessor, `width` an element (its type must have as many); normalised integers in
  // [0, 1] or [-1, 1]. Finite.
  struct Numbers {
    std::vector<float> values;
    std::size_t count = 0;  // elements
  };
  Numbers numbers(const JsonValue& index, int width) const;
  // Unsigned whole numbers.
  std::vector<std::uint32_t> wholes(const JsonValue& index, int width) const;

 private:
  struct Accessor {
    std::string_view bytes;  // from the first element on
    std::size_t count = 0, stride = 0;
    int type = 0;
    bool normalized = false;
  };
  Accessor accessor(const JsonValue& index, int width) const;

  std::string_view binary_;  // before document_, whose making sets it
  JsonDocument document_;
  std::vector<JsonValue> accessors_, views_;
};

}  // namespace skel
