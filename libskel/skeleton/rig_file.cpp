#include "libskel/skeleton/rig_file.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "libskel/core/error.h"
#include "libskel/core/json.h"
#include "libskel/core/unused_keys.h"
#include "libskel/skeleton/joint_json.h"

namespace skel {
namespace {

// A joint as it stands in the file.
struct Listed {
  JsonValue value;
  Joint joint;
  std::string parent;  // empty: none
};

// The joint's own word and that of the hierarchy.
std::string parentOf(const JsonValue& item, const std::string& name,
                     const std::optional<JsonValue>& hierarchy) {
  std::string parent;
  const std::optional<JsonValue> own = item.find("parent");
  if (own && !own->isNull()) parent = own->asString();
  const std::optional<JsonValue> above = hierarchy ? hierarchy->find(name) : std::nullopt;
  if (!above || above->isNull()) return parent;
  const std::string other = above->asString();
  if (!parent.empty() && parent != other)
    own->fail("is \"" + parent + "\", but " + above->path() + " is \"" + other + "\"");
  return other;
}

// What somebody needs who has written another form.
JsonValue requiredAt(const JsonValue& item, const char* key) {
  if (const auto value = item.find(key)) return *value;
  item.fail("lacks \"" + std::string(key) +
            "\"; a joint is written {\"name\": \"spine\", \"head\": [x, y, z], \"tail\": [x, y, z], "
            "\"parent\": \"pelvis\"}, as docs/formats.md shows under \"Skeletons of models\"");
}

std::vector<Listed> listedJoints(const JsonValue& root, const std::optional<JsonValue>& hierarchy,
                                 UnusedKeys& unused) {
  std::vector<Listed> listed;
  std::map<std::string, std::string> names;
  std::map<int, std::string> indices;
  const JsonValue list = root.at("joints");
  const std::vector<JsonValue> items = list.items();
  if (items.empty()) list.fail("is empty");
  if (items.size() > kMostJoints) list.fail("has more than " + std::to_string(kMostJoints) + " joints");
  for (const JsonValue& item : items) {
    unused.take(item, {"name", "index", "head", "tail", "parent"});
    Joint joint;
    joint.name = requiredAt(item, "name").asString();
    if (joint.name.empty()) item.at("name").fail("is empty");
    if (const auto [first, added] = names.emplace(joint.name, item.path()); !added)
      item.at("name").fail("\"" + joint.name + "\" is also the name of " + first->second);
    if (const auto index = item.find("index"))
      if (const auto [first, added] = indices.emplace(index->asInt(0, 1'000'000), item.path()); !added)
        index->fail("is also that of " + first->second);
    joint.position = positionAt(requiredAt(item, "head"));
    joint.tail = positionAt(requiredAt(item, "tail"));
    joint.confidence = 1;
    joint.origin = JointOrigin::kEdited;
    std::string parent = parentOf(item, joint.name, hierarchy);
    listed.push_back({item, std::move(joint), std::move(parent)});
  }
  return listed;
}

// The one name that the hierarchy gives a child and `joints` does not list. Empty: none.
std::string unlistedRoot(const std::vector<Listed>& listed, const std::optional<JsonValue>& hierarchy) {
  std::string root;
  if (!hierarchy) return root;
  std::set<std::string_view> names;
  for (const Listed& l : listed) names.insert(l.joint.name);
  const auto known = [&](const std::string& name) { return names.count(name) > 0; };
  for (const std::string& child : hierarchy->keys()) {
    const JsonValue parent = hierarchy->at(child);
    if (!known(child) && !parent.isNull()) parent.fail("there is no joint \"" + child + "\"");
    if (parent.isNull() || known(parent.asString())) continue;
    if (!root.empty() && root != parent.asString())
      parent.fail("there is no joint \"" + parent.asString() +
                  "\"; only one may be missing, the root, and \"" + root + "\" is");
    root = parent.asString();
  }
  return root;
}

// Their order when, again and again, those whose parent is placed are placed, in the file's order, until all
// are.
std::vector<std::size_t> parentsFirst(const std::vector<Listed>& listed, const std::string& root) {
  std::map<std::string_view, std::vector<std::size_t>> children;
  std::set<std::string_view> names{root};
  for (std::size_t i = 0; i < listed.size(); ++i) {
    children[listed[i].parent].push_back(i);
    names.insert(listed[i].joint.name);
  }
  for (const Listed& l : listed)
    if (!l.parent.empty() && !names.count(l.parent))
      l.value.at("parent").fail("there is no joint \"" + l.parent + "\"");
  std::vector<int> round(listed.size(), -1);  // in which each is placed
  std::vector<std::size_t> order = children[""];
  if (!root.empty()) order.insert(order.end(), children[root].begin(), children[root].end());
  for (const std::size_t i : order) round[i] = 0;
  for (std::size_t next = 0; next < order.size(); ++next)
    for (const std::size_t child : children[listed[order[next]].joint.name]) {
      round[child] = round[order[next]] + (child < order[next] ? 1 : 0);
      order.push_back(child);
    }
  for (std::size_t i = 0; i < listed.size(); ++i)
    if (round[i] < 0)
      listed[i].value.fail("\"" + listed[i].joint.name + "\" is its own ancestor, or below one that is");
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::pair(round[a], a) < std::pair(round[b], b); });
  return order;
}

}  // namespace

Skeleton readRigFile(const std::string& path, std::string* note) {
  const JsonDocument document = JsonDocument::readFile(path);
  const JsonValue file = document.root();
  UnusedKeys unused;
  unused.take(file, {"joints", "hierarchy"});
  const std::optional<JsonValue> hierarchy = file.find("hierarchy");
  const std::vector<Listed> listed = listedJoints(file, hierarchy, unused);
  if (note) *note = unused.note(path);
  const std::string root = unlistedRoot(listed, hierarchy);

  Skeleton skeleton;
  std::map<std::string_view, int> numbers;
  if (!root.empty()) {
    Joint joint;
    joint.name = root;
    joint.confidence = 1;
    skeleton.joints.push_back(joint);
    numbers[root] = 0;
  }
  for (const std::size_t i : parentsFirst(listed, root)) {
    const Listed& l = listed[i];
    if (l.parent.empty() && !skeleton.joints.empty())
      l.value.fail("\"" + l.joint.name + "\" has no parent, but \"" + skeleton.joints[0].name +
                   "\" is the root; only one joint may have none");
    numbers[l.joint.name] = static_cast<int>(skeleton.joints.size());
    skeleton.joints.push_back(l.joint);
    skeleton.joints.back().parent = l.parent.empty() ? -1 : numbers.at(l.parent);
  }
  return skeleton;
}

bool isSkelFile(const std::string& path) {
  const JsonDocument document = JsonDocument::readFile(path);
  return document.root().find("format").has_value();
}

}  // namespace skel
