// A stroke font: each character is a few polylines on a grid.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "libskel/core/natural_order.h"
#include "libskel/draw/canvas.h"

namespace skel {

namespace {

// From '!' to '~'. Two digits a point: x, y on a grid whose capitals reach from y = 0 to the base line y = 6
// and are 4 wide; a blank lifts the pen. After a leading '~', x counts halves.
constexpr const char* kGlyphs[] = {
    "0004 0606",                              // !
    "0001 2021",                              // "
    "1016 3036 0242 0444",                    // #
    "413010010213334445361605 2026",          // $
    "0640 0010110100 3545463635",             // %
    "46121120313205162644",                   // &
    "0001",                                   // '
    "10010516",                               // (
    "00111506",                               // )
    "2125 0244 0442",                         // *
    "0343 2125",                              // +
    "0607",                                   // ,
    "0333",                                   // -
    "0606",                                   // .
    "0640",                                   // /
    "103041453616050110",                     // 0
    "112026 1636",                            // 1
    "01103041420646",                         // 2
    "01103041423313 334445361605",            // 3
    "36300444",                               // 4
    "400003334445361605",                     // 5
    "413010010516364544331304",               // 6
    "004016",                                 // 7
    "103041423313020110 133344453616050413",  // 8
    "051636454130100102133342",               // 9
    "0303 0606",                              // :
    "0303 0607",                              // ;
    "310335",                                 // <
    "0242 0444",                              // =
    "013305",                                 // >
    "011030414224 2626",                      // ?
    "34322224344441301001051636",             // @
    "062046 1434",                            // A
    "003041423303 334445360600",              // B
    "4130100105163645",                       // C
    "00304145360600",                         // D
    "40000646 0333",                          // E
    "400006 0333",                            // F
    "41301001051636454323",                   // G
    "0006 4046 0343",                         // H
    "1030 2026 1636",                         // I
    "4045361605",                             // J
    "0006 400346",                            // K
    "000646",                                 // L
    "0600234046",                             // M
    "06004640",                               // N
    "103041453616050110",                     // O
    "06003041423303",                         // P
    "103041453616050110 2446",                // Q
    "06003041423303 2346",                    // R
    "413010010213334445361605",               // S
    "0040 2026",                              // T
    "000516364540",                           // U
    "002640",                                 // V
    "0016233640",                             // W
    "0046 4006",                              // X
    "002340 2326",                            // Y
    "00400646",                               // Z
    "10000616",                               // [
    "0046",                                   // backslash
    "00101606",                               // ]
    "022042",                                 // ^
    "0747",                                   // _
    "0011",                                   // `
    "3236 3322120305162635",                  // a
    "0006 0312223335261605",                  // b
    "3322120305162635",                       // c
    "3036 3322120305162635",                  // d
    "04343322120305162635",                   // e
    "30201116 0232",                          // f
    "3237281807 3322120305162635",            // g
    "0006 0312223336",                        // h
    "0206 0000",                              // i
    "121708 1010",                            // j
    "0006 320436",                            // k
    "000516",                                 // l
    "0206 03122326 23324346",                 // m
    "0206 0312223336",                        // n
    "122233352616050312",                     // o
    "0208 0312223335261605",                  // p
    "3238 3322120305162635",                  // q
    "0206 031222",                            // r
    "33221203142435261605",                   // s
    "101526 0222",                            // t
    "0205162635 3236",                        // u
    "~023662",                                // v
    "0216233642",                             // w
    "0236 3206",                              // x
    "~0236 6218",                             // y
    "02320636",                               // z
    "20111203141526",                         // {
    "0007",                                   // |
    "00111223141506",                         // }
    "04132434",                               // ~
};

struct Glyph {
  std::vector<Points> strokes;  // grid cells
  double width = 0;
};

Glyph glyphOf(char c) {
  if (c == ' ') return {{}, 1.6};
  if (c < '!' || c > '~') return {{{{0, 0}, {3, 0}, {3, 6}, {0, 6}, {0, 0}}}, 3};
  std::string_view code = kGlyphs[c - '!'];
  double unit = 1;
  if (code[0] == '~') unit = 0.5, code.remove_prefix(1);
  Glyph glyph{{{}}, 0};
  for (std::size_t i = 0; i < code.size();) {
    if (code[i] == ' ') {
      glyph.strokes.emplace_back();
      ++i;
      continue;
    }
    glyph.strokes.back().emplace_back(unit * (code[i] - '0'), code[i + 1] - '0');
    glyph.width = std::max(glyph.width, glyph.strokes.back().back().x());
    i += 2;
  }
  return glyph;
}

constexpr double kSpacing = 1.7;  // between characters, grid cells

// Marks of letters from U+00C0 to U+017F, by the first of their strokes below; "." has none.
constexpr std::string_view kMarks =
    "`'^~:o.,`'^:`'^:.~`'^~:./`'^:'.."
    "`'^~:o.,`'^:`'^:.~`'^~:./`'^:'.:"
    "--uu;;''^^**vvvv//--uu**;;vv^^uu**,,^^//~~--uu;;*...^^,,.'',,vv*"
    "*//'',,vv...--uu\"\"..'',,vv''^^,,vv,,vv//~~--uuoo\"\";;^^^^:''**vv.";

struct Mark {
  char name;
  int combining;        // U+0300 and so on
  const char* strokes;  // as in kGlyphs, x from the letter's middle, 3 more; y from its top, 3 more
};
constexpr Mark kMarkStrokes[] = {
    {'`', 0x300, "2031"},       {'\'', 0x301, "4031"},     {'^', 0x302, "213041"},
    {'~', 0x303, "1120314050"}, {'-', 0x304, "1151"},      {'u', 0x306, "20314050"},
    {'*', 0x307, "3030"},       {':', 0x308, "2020 4040"}, {'o', 0x30A, "203040413121 2120"},
    {'"', 0x30B, "2021 4041"},  {'v', 0x30C, "203140"},    {',', 0x327, ""},
    {';', 0x328, ""},           {'/', 0x338, ""},
};

struct Letter {
  char base;
  char mark = '.';
};

// Of UTF-8; what the font does not have shows as a box.
std::vector<Letter> lettersOf(std::string_view text) {
  std::vector<Letter> letters;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto first = static_cast<unsigned char>(text[i]);
    if (first < 0x80) {
      letters.push_back({text[i]});
      continue;
    }
    std::size_t end = i + 1;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) ++end;
    const std::string_view character = text.substr(i, end - i);
    i = end - 1;
    const int code = character.size() == 2 ? (first & 0x1F) << 6 | (character[1] & 0x3F) : 0;
    static constexpr std::pair<int, const char*> kTwo[] = {
        {0xC6, "AE"}, {0xE6, "ae"}, {0xDF, "ss"}, {0x152, "OE"}, {0x153, "oe"}};
    const auto two =
        std::find_if(std::begin(kTwo), std::end(kTwo), [&](const auto& t) { return t.first == code; });
    const auto mark = std::find_if(std::begin(kMarkStrokes), std::end(kMarkStrokes),
                                   [&](const Mark& m) { return m.combining == code; });
    const std::string base = withoutMarks(std::string(character));
    if (two != std::end(kTwo))
      letters.insert(letters.end(), {{two->second[0]}, {two->second[1]}});
    else if (mark != std::end(kMarkStrokes) && !letters.empty())
      letters.back().mark = mark->name;
    else if (base.size() == 1)
      letters.push_back({base[0], kMarks[static_cast<std::size_t>(code - 0xC0)]});
    else
      letters.push_back({'\0'});
  }
  return letters;
}

// Above small letters, above capitals, below or across.
void addMark(Letter letter, Glyph& glyph) {
  const double middle = glyph.width / 2;
  if (letter.mark == ',' || letter.mark == ';') {
    const double out = letter.mark == ',' ? -.8 : .8;
    glyph.strokes.push_back({{middle, 6.4}, {middle + .2, 7.2}, {middle + out, 7.8}});
    return;
  }
  if (letter.mark == '/') {
    if (letter.base == 'l' || letter.base == 'L')
      glyph.strokes.push_back({{-.9, 4.1}, {1.4, 2.5}});
    else
      glyph.strokes.push_back({{-.4, 6}, {glyph.width + .4, letter.base == 'o' ? 2 : 0}});
    return;
  }
  const bool is_small = letter.base >= 'a' && letter.base <= 'z' &&
                        std::string_view("bdfhklt").find(letter.base) == std::string_view::npos;
  const double top = is_small ? 0 : -2;
  for (const Mark& mark : kMarkStrokes) {
    if (mark.name != letter.mark) continue;
    const std::string_view code = mark.strokes;
    Points stroke;
    for (std::size_t i = 0; i <= code.size();) {
      if (i == code.size() || code[i] == ' ') {
        if (!stroke.empty()) glyph.strokes.push_back(std::exchange(stroke, {}));
        ++i;
        continue;
      }
      stroke.emplace_back(middle + .8 * (code[i] - '3'), top + (code[i + 1] - '0'));
      i += 2;
    }
  }
}

Glyph glyphOf(Letter letter) {
  Glyph glyph = glyphOf(letter.base);
  if (letter.mark == '.') return glyph;
  if (letter.base == 'i' || letter.base == 'j') glyph.strokes.pop_back();  // its dot
  addMark(letter, glyph);
  return glyph;
}

}  // namespace

double textWidth(std::string_view text, double height_px) {
  if (text.empty()) return 0;
  double cells = -kSpacing;
  for (const Letter letter : lettersOf(text)) cells += glyphOf(letter.base).width + kSpacing;
  return cells * height_px / 6;
}

void drawText(Image& image, const Eigen::Vector2d& origin, std::string_view text, double height_px,
              Color color) {
  const double cell = height_px / 6, width_px = std::max(1.1, height_px / 7.5);
  double x = origin.x();
  for (const Letter letter : lettersOf(text)) {
    const Glyph glyph = glyphOf(letter);
    for (const Points& stroke : glyph.strokes) {
      Points points;
      for (const Eigen::Vector2d& p : stroke)
        points.emplace_back(x + p.x() * cell, origin.y() + (p.y() - 6) * cell);
      drawPolyline(image, points, width_px, color);
    }
    x += (glyph.width + kSpacing) * cell;
  }
}

}  // namespace skel
