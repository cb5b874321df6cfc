// A stroke font: each character is a few polylines on a grid.
#include <algorithm>
#include <cmath>

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

}  // namespace

double textWidth(std::string_view text, double height_px) {
  if (text.empty()) return 0;
  double cells = -kSpacing;
  for (const char c : text) cells += glyphOf(c).width + kSpacing;
  return cells * height_px / 6;
}

void drawText(Image& image, const Eigen::Vector2d& origin, std::string_view text, double height_px,
              Color color) {
  const double cell = height_px / 6, width_px = std::max(1.1, height_px / 7.5);
  double x = origin.x();
  for (const char c : text) {
    const Glyph glyph = glyphOf(c);
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
