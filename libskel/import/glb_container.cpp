// glTF 2.0 (ISO/IEC 12113:2022): section 4.4, the GLB container; 3.6, binary data.
#include "libskel/import/glb_container.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "libskel/core/error.h"
#include "libskel/core/foreign_files.h"

namespace skel {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67, kJson = 0x4e4f534a, kBinary = 0x004e4942;
enum ComponentType { kInt8 = 5120, kUint8, kInt16, kUint16, kUint32 = 5125, kFloat };

std::uint32_t word(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
  return value;
}

std::string_view chunk(std::string_view bytes, std::size_t at, std::uint32_t type, const std::string& file) {
  if (bytes.size() < at + 8) throw InputError(file, "ends in the middle of a chunk's header");
  if (word(bytes, at + 4) != type)
    throw InputError(file, type == kJson ? "its first chunk is not JSON" : "its second chunk is not BIN");
  const std::size_t size = word(bytes, at);
  if (size > bytes.size() - at - 8)
    throw InputError(file, "is cut off: a chunk of " + std::to_string(size) + " bytes has only " +
                               std::to_string(bytes.size() - at - 8));
  return bytes.substr(at + 8, size);
}

// The JSON text of a GLB; `binary` becomes the other chunk.
std::string_view split(std::string_view bytes, const std::string& file, std::string_view& binary) {
  if (bytes.empty()) throw InputError(file, "is empty, not a GLB file");
  if (bytes.size() < 12 || word(bytes, 0) != kMagic) {
    const std::string remedy = howToConvert(file);
    throw InputError(file, remedy.empty() ? "is not a GLB file" : remedy);
  }
  if (word(bytes, 4) != 2)
    throw InputError(file, "is of glTF version " + std::to_string(word(bytes, 4)) + ", 2 is read");
  const std::size_t length = word(bytes, 8);
  if (length > bytes.size())
    throw InputError(file, "is cut off: " + std::to_string(bytes.size()) + " of " + std::to_string(length) +
                               " bytes are there");
  bytes = bytes.substr(0, length);
  const std::string_view text = chunk(bytes, 12, kJson, file);
  const std::size_t next = 20 + text.size();
  if (next < bytes.size()) binary = chunk(bytes, next, kBinary, file);
  return text;
}

std::size_t sizeAt(const JsonValue& object, std::string_view key, std::size_t otherwise) {
  const std::optional<JsonValue> value = object.find(key);
  return value ? static_cast<std::size_t>(value->asNumber(0, 4294967295.0)) : otherwise;
}

template <class T>
T load(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

std::size_t componentSize(int type) {
  switch (type) {
    case kInt8:
    case kUint8:
      return 1;
    case kInt16:
    case kUint16:
      return 2;
    case kUint32:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

float component(const char* at, int type, bool normalized) {
  const auto whole = [&](auto value) {
    constexpr float kMost = static_cast<float>(std::numeric_limits<decltype(value)>::max());
    const float number = static_cast<float>(value);
    return normalized ? std::max(-1.0f, number / kMost) : number;
  };
  switch (type) {
    case kInt8:
      return whole(load<std::int8_t>(at));
    case kUint8:
      return whole(load<std::uint8_t>(at));
    case kInt16:
      return whole(load<std::int16_t>(at));
    case kUint16:
      return whole(load<std::uint16_t>(at));
    case kUint32:
      return whole(load<std::uint32_t>(at));
    default:
      return load<float>(at);
  }
}

}  // namespace

GlbContainer::GlbContainer(std::string_view bytes, const std::string& file)
    : document_(JsonDocument::parse(split(bytes, file, binary_), file)) {
  const JsonValue version = root().at("asset").at("version");
  if (!version.asString().starts_with("2.")) version.fail("is \"" + version.asString() + "\", 2.0 is read");
  if (const auto list = root().find("accessors")) accessors_ = list->items();
  if (const auto list = root().find("bufferViews")) views_ = list->items();
}

int GlbContainer::count(std::string_view list) const {
  const std::optional<JsonValue> found = root().find(list);
  return found ? static_cast<int>(found->size()) : 0;
}

JsonValue GlbContainer::element(std::string_view list, const JsonValue& index) const {
  const std::optional<JsonValue> found = root().find(list);
  const std::size_t size = found ? found->size() : 0;
  if (size == 0) index.fail("names one of the " + std::string(list) + ", but there are none");
  return found->item(static_cast<std::size_t>(index.asInt(0, static_cast<int>(size) - 1)));
}

std::string_view GlbContainer::view(const JsonValue& index) const {
  if (views_.empty()) index.fail("names a buffer view, but there are none");
  const JsonValue& view =
      views_[static_cast<std::size_t>(index.asInt(0, static_cast<int>(views_.size()) - 1))];
  const JsonValue buffer = element("buffers", view.at("buffer"));
  if (view.at("buffer").asInt(0, 1 << 20) != 0 || buffer.find("uri"))
    buffer.fail("lies outside of the file; export as one .glb");
  const std::size_t begin = sizeAt(view, "byteOffset", 0), size = sizeAt(view, "byteLength", 0);
  if (begin > binary_.size() || size > binary_.size() - begin)
    view.fail("ends at byte " + std::to_string(begin + size) + ", the file has " +
              std::to_string(binary_.size()));
  return binary_.substr(begin, size);
}

GlbContainer::Accessor GlbContainer::accessor(const JsonValue& index, int width) const {
  if (accessors_.empty()) index.fail("names an accessor, but there are none");
  const JsonValue& found =
      accessors_[static_cast<std::size_t>(index.asInt(0, static_cast<int>(accessors_.size()) - 1))];
  if (found.find("sparse")) found.at("sparse").fail("is not read; export without sparse accessors");
  const std::string expected = width == 1 ? "SCALAR" : width == 16 ? "MAT4" : "VEC" + std::to_string(width);
  if (found.at("type").asString() != expected)
    found.at("type").fail("is " + found.at("type").asString() + ", must be " + expected);
  Accessor result;
  result.type = found.at("componentType").asInt(0, 65535);
  const std::size_t size = componentSize(result.type) * static_cast<std::size_t>(width);
  if (size == 0) found.at("componentType").fail("is none of glTF's");
  if (const auto normalized = found.find("normalized")) result.normalized = normalized->asBool();
  result.count = sizeAt(found, "count", 0);
  if (result.count == 0) found.fail("is empty");
  const JsonValue view_index = found.at("bufferView");
  result.bytes = view(view_index);
  result.stride = sizeAt(views_[static_cast<std::size_t>(view_index.asInt(0, 1 << 30))], "byteStride", size);
  const std::size_t begin = sizeAt(found, "byteOffset", 0);
  if (result.stride < size || begin > result.bytes.size() || size > result.bytes.size() - begin ||
      (result.count - 1) > (result.bytes.size() - begin - size) / result.stride)
    found.fail("has " + std::to_string(result.count) + " elements, more than its buffer view holds");
  result.bytes.remove_prefix(begin);
  return result;
}

GlbContainer::Numbers GlbContainer::numbers(const JsonValue& index, int width) const {
  const Accessor from = accessor(index, width);
  Numbers result;
  result.count = from.count;
  result.values.reserve(from.count * static_cast<std::size_t>(width));
  const std::size_t step = componentSize(from.type);
  for (std::size_t i = 0; i < from.count; ++i) {
    for (int k = 0; k < width; ++k) {
      const char* at = from.bytes.data() + i * from.stride + static_cast<std::size_t>(k) * step;
      result.values.push_back(component(at, from.type, from.normalized));
      if (!std::isfinite(result.values.back()))
        index.fail("number " + std::to_string(k) + " of element " + std::to_string(i) + " is not finite");
    }
  }
  return result;
}

std::vector<std::uint32_t> GlbContainer::wholes(const JsonValue& index, int width) const {
  const Accessor from = accessor(index, width);
  if (from.type != kUint8 && from.type != kUint16 && from.type != kUint32)
    index.fail("must be unsigned whole numbers");
  std::vector<std::uint32_t> result;
  result.reserve(from.count * static_cast<std::size_t>(width));
  for (std::size_t i = 0; i < from.count; ++i) {
    for (int k = 0; k < width; ++k) {
      const char* at = from.bytes.data() + i * from.stride;
      result.push_back(from.type == kUint8    ? load<std::uint8_t>(at + k)
                       : from.type == kUint16 ? load<std::uint16_t>(at + 2 * k)
                                              : load<std::uint32_t>(at + 4 * k));
    }
  }
  return result;
}

}  // namespace skel
