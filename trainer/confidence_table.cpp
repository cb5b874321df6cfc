#include "trainer/confidence_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>

#include "libskel/core/error.h"

namespace skel {
namespace {

constexpr std::string_view kTableFormat = "skel-confidence-table";
constexpr int kTableVersion = 1;

constexpr std::array<std::string_view, kDisturbances> kDisturbanceNames = {
    "none", "found", "warped", "turned", "thing", "limb", "bite", "cut", "pair", "other plan"};

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> out;
  while (true) {
    const std::size_t end = line.find(',');
    out.push_back(line.substr(0, end));
    if (end == line.npos) return out;
    line.remove_prefix(end + 1);
  }
}

struct BadCell {};
struct NewerVersion {
  std::string_view version;
};

// What would end a cell or a line stands as in an address: "a%2Cb".
std::string cellOf(std::string_view name) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string cell;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= ' ' && c != ',' && c != '%')
      cell += c;
    else
      (cell += '%').append({kDigits[byte / 16], kDigits[byte % 16]});
  }
  return cell;
}

std::string nameIn(std::string_view cell) {
  std::string name;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    if (cell[i] != '%') {
      name += cell[i];
      continue;
    }
    unsigned byte = 0;
    const std::string_view digits = cell.substr(i + 1, 2);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
    if (digits.size() != 2 || error != std::errc() || end != digits.data() + digits.size()) throw BadCell();
    name += static_cast<char>(byte);
    i += 2;
  }
  return name;
}

double numberOf(std::string_view cell) {
  constexpr double kMost = 1e6;  // no input is as large; squares are summed
  double number = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc() || end != cell.data() + cell.size() || !(std::abs(number) <= kMost))
    throw BadCell();
  return number;
}

// Right, wrong or not known.
int rightOf(std::string_view cell) {
  const double number = numberOf(cell);
  if (number != -1 && number != 0 && number != 1) throw BadCell();
  return static_cast<int>(number);
}

// Adds the line, whose cells these are.
void addLine(const std::vector<std::string_view>& line, std::vector<ConfidenceSample>& samples) {
  constexpr std::size_t kFigure = 6, kJoint = 7;  // cells before the inputs
  constexpr std::size_t kMostJoints = 63;         // as of a joint net
  if (line[0] == kTableFormat && line.size() == 2) {
    const double version = numberOf(line[1]);
    if (version > kTableVersion) throw NewerVersion{line[1]};
    if (version != kTableVersion) throw BadCell();
    return;
  }
  if (line[0] == "F" && line.size() == kFigure + kFigureInputs.size()) {
    ConfidenceSample sample;
    sample.drawing = nameIn(line[1]);
    const auto kind = std::find(kDisturbanceNames.begin(), kDisturbanceNames.end(), line[2]);
    if (kind == kDisturbanceNames.end()) throw BadCell();
    sample.disturbance = static_cast<Disturbance>(kind - kDisturbanceNames.begin());
    sample.body_plan = line[3];
    sample.usable = numberOf(line[4]) != 0;
    sample.likeness = numberOf(line[5]);
    sample.evidence.figure.resize(static_cast<Eigen::Index>(kFigureInputs.size()));
    for (std::size_t i = 0; i < kFigureInputs.size(); ++i)
      sample.evidence.figure[static_cast<Eigen::Index>(i)] = numberOf(line[kFigure + i]);
    samples.push_back(std::move(sample));
    return;
  }
  if (line[0] != "J" || line.size() != kJoint + kJointInputs.size() || samples.empty()) throw BadCell();
  ConfidenceSample& sample = samples.back();
  if (sample.right.size() == kMostJoints) throw BadCell();
  sample.right.push_back(rightOf(line[4]));
  sample.masses.push_back(numberOf(line[5]));
  sample.evidence.counts.push_back(numberOf(line[6]) != 0);
  Eigen::ArrayXXd& joints = sample.evidence.joints;
  joints.conservativeResize(joints.rows() + 1, static_cast<Eigen::Index>(kJointInputs.size()));
  for (std::size_t i = 0; i < kJointInputs.size(); ++i)
    joints(joints.rows() - 1, static_cast<Eigen::Index>(i)) = numberOf(line[kJoint + i]);
}

}  // namespace

std::string formatConfidenceTable(const std::vector<ConfidenceSample>& samples) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(5);
  out << kTableFormat << "," << kTableVersion << "\n";
  for (const ConfidenceSample& s : samples) {
    const std::string head = cellOf(s.drawing) + "," +
                             std::string(kDisturbanceNames[static_cast<std::size_t>(s.disturbance)]) + "," +
                             s.body_plan;
    out << "F," << head << "," << s.usable << "," << s.likeness;
    for (const double v : s.evidence.figure) out << "," << v;
    out << "\n";
    for (std::size_t j = 0; j < s.right.size(); ++j) {
      out << "J," << head << "," << s.right[j] << "," << s.masses[j] << "," << s.evidence.counts[j];
      for (const double v : s.evidence.joints.row(static_cast<Eigen::Index>(j))) out << "," << v;
      out << "\n";
    }
  }
  return out.str();
}

std::vector<ConfidenceSample> parseConfidenceTable(std::string_view text, const std::string& file) {
  std::vector<ConfidenceSample> samples;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    try {
      addLine(cells(text.substr(0, end)), samples);
    } catch (const BadCell&) {
      throw InputError(
          file, "line " + std::to_string(line) + " is none of a table that skel-train confidence writes");
    } catch (const NewerVersion& newer) {
      throw InputError(file, "line " + std::to_string(line) + ": version is " + std::string(newer.version) +
                                 ", this program reads up to " + std::to_string(kTableVersion) +
                                 "; use a newer skel");
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return samples;
}

}  // namespace skel
