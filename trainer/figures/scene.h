// A drawing as a pile of flat parts, from the back to the front, and its rasteriser.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace skel {

using Colour = std::array<std::uint8_t, 3>;

// How a part is painted.
struct Ink {
  Colour fill{200, 200, 200};
  Colour rim{20, 20, 20};
  double rim_width = 0;      // unit of the scene; the rim lies outside the part
  bool hollow = false;       // only the rim is figure, the inside is a hole
  bool inside_only = false;  // painted only where there is figure already: a face, a button
  int stripe_period = 0;     // px of the raster; 0: plain. Stripes have the colour of the rim.
  bool stripes_upright = false;
};

// What a part belongs to, to tell whether a joint is covered by something else. kNone: things, and what is
// painted onto other parts.
enum class PartOwner : std::uint8_t {
  kNone,
  kHead,
  kTorso,
  kLeftArm,
  kRightArm,
  kLeftLeg,
  kRightLeg,
  kTail,
  kHair,      // that hangs from the head
  kSkirt,     // skirt, robe, coat, from where it leaves the torso or above
  kAppendix,  // cape, wings, tail of somebody on two legs
};
// Whose joints it does not cover: hair is the head's, a skirt the torso's.
PartOwner bearer(PartOwner owner);

struct Raster;

// Pieces added between two begin() are one part: their union gets one rim. Coordinates have +y down.
class Scene {
 public:
  void begin(const Ink& ink, PartOwner owner = PartOwner::kNone);

  void disc(const Eigen::Vector2d& centre, double radius);
  // exponent 2: an ellipse; larger: towards a rounded rectangle. The angle turns +x towards +y.
  void ellipse(const Eigen::Vector2d& centre, const Eigen::Vector2d& half_axes, double angle,
               double exponent = 2);
  // A simple polygon.
  void polygon(std::span<const Eigen::Vector2d> corners);
  void polygon(std::initializer_list<Eigen::Vector2d> corners);
  // The union of the discs that run along a polyline while their radius changes linearly.
  void path(std::span<const Eigen::Vector2d> centres, std::span<const double> radii);
  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius_a, double radius_b);
  // A circle's line.
  void ring(const Eigen::Vector2d& centre, double radius, double half_width);

  // Moves every corner.
  void transform(const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& move);
  // Without what is painted onto other parts and belongs to none of its own.
  Scene withoutDetails() const;
  // Puts the parts of another scene in front.
  void append(const Scene& front);

  struct Box {
    Eigen::Vector2d low, high;
  };
  Box box() const;
  bool empty() const { return parts_.empty(); }

 private:
  friend struct Raster;
  friend Raster rasterize(const Scene& scene, const Eigen::Vector2d& low, double scale, int width,
                          int height);

  struct Part {
    Ink ink;
    PartOwner owner;
  };
  struct Piece {
    int begin, end;  // corners
    int part;
    bool rim;
  };
  void addPiece(bool rim, int first);

  std::vector<Part> parts_;
  std::vector<Piece> pieces_;
  std::vector<Eigen::Vector2d> corners_;
};

// A scene in pixels: 0 where there is nothing, else the part on top.
struct Raster {
  int width = 0, height = 0;
  std::vector<std::uint16_t> part;  // 1 + part, or 0
  std::vector<std::uint8_t> rim;    // 1 on a part's rim
  std::vector<Scene::Part> parts;

  bool solid(int x, int y) const { return part[y * width + x] != 0; }
  Colour colour(int x, int y) const;
  PartOwner owner(int x, int y) const;
};

// Pixel (x, y) shows the scene's point low + ((x, y) + 0.5) / scale.
Raster rasterize(const Scene& scene, const Eigen::Vector2d& low, double scale, int width, int height);

}  // namespace skel
