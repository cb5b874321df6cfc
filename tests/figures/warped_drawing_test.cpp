#include "trainer/figures/warped_drawing.h"

#include "tests/support/catch.h"
#include "tests/support/marked_figure.h"
#include "trainer/figures/drawing.h"

namespace skel {
namespace {

SmallDrawing markedDrawing() {
  const MarkedFigure figure = markedFigure(jointNames(figurePlan("biped")));
  return smallDrawing(figure.image, figure.mask, figure.joints, FigureView::kFront);
}

TEST_CASE("the joints of a drawing stay on their marks, whatever the warp") {
  const SmallDrawing drawing = markedDrawing();
  CHECK(std::max(drawing.image.width, drawing.image.height) == kSmallLongSide);
  Rng rng(4);
  for (int i = 0; i < 60; ++i) {
    const WarpedDrawing warped = warpedDrawing(rng, drawing, i % 3 == 0 ? rng.uniform(0, 6.28) : 0, 256, 12);
    CHECK(std::max(warped.width, warped.height) == Approx(256 + 24).margin(3));
    REQUIRE(warped.joints.size() == drawing.joints.size());
    for (std::size_t j = 0; j < warped.joints.size(); ++j) {
      INFO("warp " << i << ", joint " << j);
      const int x = static_cast<int>(warped.joints[j].x()), y = static_cast<int>(warped.joints[j].y());
      const std::size_t at = static_cast<std::size_t>(y) * warped.width + x;
      CHECK(warped.solid[at] == 1);
      CHECK(showsMark(warped.colours[at].data(), j));
    }
  }
}

TEST_CASE("figures of drawings are generated as often as asked for") {
  FigureOptions options;
  options.drawings = {markedDrawing()};
  options.drawn_share = 1;
  Rng rng(9);
  const Figure figure = generateFigure(rng, options);
  CHECK(figure.whole);
  CHECK(std::max(figure.mask.rows(), figure.mask.cols()) == 128);
  CHECK(figure.joints.size() == options.drawings[0].joints.size());
  CHECK(figure.look.known());

  options.other_share = 1;
  for (int i = 0; i < 20; ++i) CHECK_FALSE(generateFigure(rng, options).whole);

  // Without a share the drawings change nothing.
  options.other_share = options.drawn_share = 0;
  Rng one(5), other(5);
  CHECK((generateFigure(one, options).mask == generateFigure(other).mask).all());
}

}  // namespace
}  // namespace skel
