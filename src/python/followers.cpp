// Levels of detail: some strands are simulated, the others follow them on the device.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "python/arrays.h"
#include "python/binding.h"
#include "python/hair.h"
#include "ringlet/follow/followers.h"
#include "ringlet/follow/level_of_detail.h"

namespace ringlet::python {
namespace {

struct LevelObject {
  GroomHandle whole, groom;  // of all strands, and of those that are simulated
  LevelOfDetail level;
};
using LevelHandle = std::shared_ptr<LevelObject>;

using Strands = std::variant<std::int64_t, std::vector<std::int64_t>>;

// A number of guides, or which strands they are, in any order.
Result<LevelOfDetail> levelWith(const Groom& groom, const Strands& guides) {
  if (const auto* count = std::get_if<std::int64_t>(&guides)) {
    if (*count < 1) throw py::value_error(fmt::format("guides is at least 1, got {}", *count));
    return levelOfDetailOfCount(groom, static_cast<std::size_t>(*count));
  }
  std::vector<std::uint32_t> strands;
  for (const std::int64_t s : std::get<std::vector<std::int64_t>>(guides)) {
    if (s < 0 || s >= static_cast<std::int64_t>(groom.strandCount()))
      throw py::value_error(
          fmt::format("guides are strands from 0 to {}, got {}", groom.strandCount() - 1, s));
    strands.push_back(static_cast<std::uint32_t>(s));
  }
  std::ranges::sort(strands);
  if (strands.empty() || std::ranges::adjacent_find(strands) != strands.end())
    throw py::value_error("guides are strands of the groom, at least one, and each once");
  return levelOfDetailOfGuides(groom, std::move(strands));
}

LevelHandle makeLevel(GroomHandle whole, std::optional<double> share, const std::optional<Strands>& guides) {
  if (share.has_value() == guides.has_value()) throw py::value_error("name one of share and guides");
  if (share && !(*share > 0 && *share <= 1))
    throw py::value_error(fmt::format("share is above 0 and at most 1, got {}", *share));
  LevelOfDetail level = withoutGil([&] {
    return valueOf(share ? levelOfDetail(whole->groom(), *share) : levelWith(whole->groom(), *guides));
  });
  auto groom = std::make_shared<GroomObject>(LoadedGroom{.groom = level.groom});
  return std::make_shared<LevelObject>(LevelObject{std::move(whole), std::move(groom), std::move(level)});
}

// The library's is for one thread at a time, which no other may call its hair from meanwhile.
class FollowersObject {
 public:
  FollowersObject(HairHandle hair, LevelHandle level)
      : hair_(std::move(hair)), level_(std::move(level)), followers_(make(*hair_, *level_)) {}

  void follow() {
    hair_->ask([&](Simulation& simulation) {
      demand(followers_.follow());
      head_ = simulation.head();
    });
  }
  std::vector<Vec3f> positions() {
    return hair_->ask([&](Simulation&) { return valueOf(followers_.positions()); });
  }
  std::vector<Vec3f> points() {
    std::vector<Vec3f> points = positions();
    placeInWorld(points, head_, level_->groom->groom().metresPerUnit);
    return points;
  }
  const std::vector<std::uint32_t>& firstPoint() const { return followers_.firstPoint(); }

 private:
  static Followers make(HairObject& hair, const LevelObject& level) {
    const AssetObject& asset = *hair.asset();
    const Groom& own = asset.groom->groom();
    const Groom& groom = level.level.groom;
    if (own.points != groom.points || own.firstPoint != groom.firstPoint ||
        own.metresPerUnit != groom.metresPerUnit)
      throw py::value_error("this hair is not of level.groom: make its asset of that");
    return hair.ask([&](Simulation& simulation) {
      return valueOf(
          Followers::create(asset.device->device, simulation, groom, level.level.hairs, {}, level.level.own));
    });
  }

  HairHandle hair_;
  LevelHandle level_;
  HeadPose head_{};  // when they followed
  Followers followers_;
};

void addLevel(py::module_& module) {
  py::class_<LevelObject, LevelHandle>(
      module, "LevelOfDetail",
      "Some of a groom's strands, its guides, and how all others follow them. Constant.")
      .def(
          py::init(&makeLevel), py::arg("groom").none(false), py::arg("share") = py::none(), py::kw_only(),
          py::arg("guides") = py::none(),
          "share: of strands that are picked, above 0, at most 1; or guides: their number, or which strands. "
          "ringlet.Error for a strand without length.")
      .def_property_readonly(
          "groom", [](const LevelObject& self) { return self.groom; },
          "The Groom of the strands that are simulated: what an Asset is made of.")
      .def_property_readonly(
          "whole", [](const LevelObject& self) { return self.whole; }, "The Groom of all strands.")
      .def_property_readonly(
          "guides",
          [](const py::object& self) { return viewOf(self.cast<const LevelObject&>().level.guides, self); },
          "(strands of groom,) uint32: which strands of `whole` they are, ascending.")
      .def(
          "__repr__",
          [](const LevelObject& self) {
            return fmt::format("<ringlet.LevelOfDetail: {} strands of {}>", self.groom->groom().strandCount(),
                               self.whole->groom().strandCount());
          },
          "What it is, in a line.");
}

void addFollowersClass(py::module_& module) {
  py::class_<FollowersObject>(module, "Followers",
                              "All strands of a groom, which follow a Hair of some of them on its device.")
      .def(py::init<HairHandle, LevelHandle>(), py::arg("hair").none(false), py::arg("level").none(false),
           "hair: a Hair of level.groom, which may have moved. ValueError for another.")
      .def("follow", &FollowersObject::follow,
           "Moves the strands to where the hair is after its last frame. Waits for all frames.")
      .def(
          "positions", [](FollowersObject& self) { return arrayOf(self.positions()); },
          "(points, 3) float32 [m], seen from the head: strand after strand of the whole groom, each with "
          "its own points, as of the last follow(), which comes first.")
      .def(
          "points", [](FollowersObject& self) { return arrayOf(self.points()); },
          "The same in the world, in the groom's unit.")
      .def_property_readonly(
          "first_point",
          [](const py::object& self) {
            return viewOf(self.cast<const FollowersObject&>().firstPoint(), self);
          },
          "(strands + 1,) uint32: where each strand's points begin.")
      .def(
          "__repr__",
          [](const FollowersObject& self) {
            return fmt::format("<ringlet.Followers: {} strands>", self.firstPoint().size() - 1);
          },
          "What it is, in a line.");
}

}  // namespace

void addFollowers(py::module_& module) {
  addLevel(module);
  addFollowersClass(module);
}

}  // namespace ringlet::python
