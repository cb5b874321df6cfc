#include "trainer/generated_characters.h"

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("generated characters are the same with any number of threads, and others for another seed") {
  const auto one = generateCharacters(6, 1, 1), four = generateCharacters(8, 1, 4),
             other = generateCharacters(6, 2, 1);
  REQUIRE(one.size() == 6);
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].features == four[i].features);
    CHECK(one[i].labels == four[i].labels);
    CHECK_FALSE((one[i].features.rows() == other[i].features.rows() && one[i].features == other[i].features));
  }
}

TEST_CASE("generated characters have candidates of all classes where they belong") {
  // Means over the figures: y goes down.
  std::array<double, kJointClassCount> count{}, y{}, radius{};
  for (const LabelledCharacter& character : generateCharacters(60, 3)) {
    REQUIRE(character.features.rows() == static_cast<Eigen::Index>(character.labels.size()));
    REQUIRE(character.features.rows() > 0);
    for (std::size_t i = 0; i < character.labels.size(); ++i) {
      const auto row = character.features.row(static_cast<Eigen::Index>(i));
      CHECK((row.array() >= 0 && row.array() <= 1).all());
      const auto c = static_cast<std::size_t>(character.labels[i]);
      ++count[c], y[c] += row[1], radius[c] += row[2];
    }
  }
  for (std::size_t c = 0; c < count.size(); ++c) {
    REQUIRE(count[c] > 100);
    y[c] /= count[c], radius[c] /= count[c];
  }
  const auto [head, body, hand, leg] = std::array<std::size_t, 4>{0, 1, 2, 3};
  CHECK(y[head] < y[hand]);
  CHECK(y[hand] < y[leg]);
  CHECK(y[body] < y[leg]);
  CHECK(radius[body] > radius[hand]);
  CHECK(radius[body] > radius[leg]);
}
