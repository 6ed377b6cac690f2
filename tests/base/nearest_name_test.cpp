// Mirrors ringlet/base/nearest_name.h: the distance is what its definition, taken literally, gives.
#include "ringlet/base/nearest_name.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace ringlet::nearest_name_test {
namespace {

std::size_t distance(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return a.size() + b.size();
  const std::string restOfA = a.substr(1), restOfB = b.substr(1);
  return std::min({distance(restOfA, b) + 1, distance(a, restOfB) + 1,
                   distance(restOfA, restOfB) + (a[0] == b[0] ? 0 : 1)});
}

TEST(NearestName, IsTheOneOfTheLeastDistanceThatIsNear) {
  std::mt19937 random(3);
  const auto word = [&] {
    std::string letters(1 + random() % 6, 'a');
    for (char& letter : letters) letter = static_cast<char>('a' + random() % 3);
    return letters;
  };
  int found = 0;
  for (int round = 0; round < 300; ++round) {
    const std::string typed = word();
    std::vector<std::string> names{word(), word(), word(), word()};
    std::size_t expected = names.size(), least = std::max<std::size_t>(2, typed.size() / 3) + 1;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::size_t d = distance(typed, names[i]);
      if (d < least && d < names[i].size()) least = d, expected = i;
    }
    EXPECT_EQ(nearestName(typed, names), expected) << typed << " of " << names[0] << ' ' << names[1];
    found += expected < names.size();
  }
  EXPECT_GT(found, 100);
  EXPECT_LT(found, 300);
}

TEST(NearestName, ForgivesTwoLettersOrAThird) {
  const std::vector<std::string> names{"bend_stiffness", "core_stiffness"};
  EXPECT_EQ(nearestName("bend_stifness", names), 0u);
  EXPECT_EQ(nearestName("coer_stiffnes", names), 1u);
  EXPECT_EQ(nearestName("stiffness", names), 2u);
  EXPECT_EQ(nearestName("", {"a"}), 1u);
}

}  // namespace
}  // namespace ringlet::nearest_name_test
