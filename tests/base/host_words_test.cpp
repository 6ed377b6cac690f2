// What sentences say in the words of hosts and scene files.
#include "ringlet/base/host_words.h"

#include <gtest/gtest.h>

#include <string>

namespace ringlet::host_words_test {
namespace {

constexpr HostWord kWords[] = {
    {"unit", "metres_per_unit", "metres_per_unit={}"},
    {"up", "up_is_z", "up_is_z = 1", "Z"},
    {"up", "up_is_z", "up_is_z = 0"},
    {"root-end", "root_end", "root_end=\"{}\""},
    {"points-per-strand", "points_per_strand", "points_per_strand={}"},
};

struct Case {
  const char *sentence, *host, *scene;
};
// Each form in which sentences of the library name an option.
constexpr Case kCases[] = {
    {"is the unit right (--unit)?", "is the unit right (metres_per_unit)?",
     "is the unit right (unit of [groom])?"},
    {"1 m with --unit 0.01 or 2 mm with --unit 1e-05",
     "1 m with metres_per_unit=0.01 or 2 mm with metres_per_unit=1e-05",
     "1 m with unit = 0.01 of [groom] or 2 mm with unit = 1e-05 of [groom]"},
    {"a groom takes up = \"Z\" of [groom] (--up Z)", "a groom takes up_is_z = 1",
     "a groom takes up = \"Z\" of [groom]"},
    {"to Y up (--up Z keeps its axes)", "to Y up (up_is_z = 1 keeps its axes)",
     "to Y up (up = \"Z\" of [groom] keeps its axes)"},
    {"to Z up (--up Y keeps its axes)", "to Z up (up_is_z = 0 keeps its axes)",
     "to Z up (up = \"Y\" of [groom] keeps its axes)"},
    {"; root_end = \"last\" of [groom] (--root-end last) turns them round",
     "; root_end=\"last\" turns them round", "; root_end = \"last\" of [groom] turns them round"},
    {"say how many: --points-per-strand N (points_per_strand of [groom])",
     "say how many: points_per_strand=N", "say how many: points_per_strand of [groom]"},
    {"--motion-up -Z (up = \"-Z\" of [motion]) says so", "--motion-up -Z (up = \"-Z\" of [motion]) says so",
     "up = \"-Z\" of [motion] says so"},
    {"right (--motion-unit, unit of [motion])?", "right (--motion-unit, unit of [motion])?",
     "right (unit of [motion])?"},
    {"1 m with --motion-unit 0.01", "1 m with --motion-unit 0.01", "1 m with unit = 0.01 of [motion]"},
    // Of other programs, and of files.
    {"`ringlet info --fix` with it", "`ringlet info --fix` with it", "`ringlet info --fix` with it"},
    {"`usdcat --flatten`", "`usdcat --flatten`", "`usdcat --flatten`"},
    {"my--unit.obj: found {} and $1 \\1", "my--unit.obj: found {} and $1 \\1",
     "my--unit.obj: found {} and $1 \\1"},
    {"", "", ""},
};

TEST(HostWords, EachFormIsSaidInThem) {
  for (const Case& c : kCases) {
    EXPECT_EQ(inHostWords(c.sentence, kWords), c.host);
    EXPECT_EQ(inSceneWords(c.sentence), c.scene);
    EXPECT_EQ(inHostWords(c.sentence, {}), c.sentence) << "without words";
  }
}

}  // namespace
}  // namespace ringlet::host_words_test
