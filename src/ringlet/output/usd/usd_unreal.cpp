// Implements output/usd/usd_unreal.h.
#include "ringlet/output/usd/usd_unreal.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace ringlet {
namespace {

constexpr std::string_view kPrefix = "primvars:groom_";
// Types of primvars that the importer reads.
constexpr std::array<std::string_view, 8> kTypes{"int",    "float",    "float2",  "texCoord2f",
                                                 "float3", "vector3f", "double2", "string"};

class UnrealValues {
 public:
  UnrealValues(const Groom& topology, const HairCurves& curves, const std::vector<UsdStageAttribute>& said,
               UsdStagePrim& prim)
      : first_(topology.firstPoint.begin() + curves.firstStrand, curves.strandCount + 1),
        said_(said),
        prim_(prim) {}

  // Those that are the schema's own.
  void carry() {
    for (const UsdStageAttribute& value : said_) {
      std::string_view type = value.type;
      if (type.ends_with("[]")) type.remove_suffix(2);
      if (value.name.starts_with(kPrefix) && std::ranges::count(kTypes, type) > 0) add(value);
    }
  }

  void widen() {
    for (UsdStageAttribute& value : prim_.attributes) {
      if (value.name != "widths" || value.interpolation != "constant") continue;
      value.interpolation = "uniform";
      value.numbers.assign(strandCount(), value.numbers.empty() ? 0.0 : value.numbers.front());
    }
  }

  // A number of each strand: the file's, else `firstNumber` and those that follow.
  void addIds(std::uint32_t firstNumber) {
    UsdStageAttribute ids{.name = "primvars:groom_id", .type = "int[]", .interpolation = "uniform"};
    const UsdStageAttribute* own = find({"primvars:id", "ids"});
    if (own && own->numbers.size() == strandCount() && own->interpolation != "vertex") {
      ids.numbers = own->numbers;
    } else {
      for (std::size_t s = 0; s < strandCount(); ++s) ids.numbers.push_back(double(firstNumber + s));
    }
    add(std::move(ids));
  }

  // Of each strand's root.
  void addRootUvs() {
    const UsdStageAttribute* uvs = find({"primvars:st", "primvars:uv", "primvars:UVMap"});
    const auto type = uvs ? usdTypeOf(uvs->type) : std::nullopt;
    if (!type || type->width() != 2) return;
    const bool isOfPoints = uvs->numbers.size() == 2 * pointCount() && uvs->interpolation != "uniform";
    if (!isOfPoints && uvs->numbers.size() != 2 * strandCount()) return;
    UsdStageAttribute roots{
        .name = "primvars:groom_root_uv", .type = "texCoord2f[]", .interpolation = "uniform"};
    for (std::size_t s = 0; s < strandCount(); ++s) {
      const std::size_t at = 2 * (isOfPoints ? first_[s] - first_[0] : s);
      roots.numbers.insert(roots.numbers.end(), {uvs->numbers[at], uvs->numbers[at + 1]});
    }
    add(std::move(roots));
  }

  // Of each point; a color3f is none of the importer's types.
  void addColours() {
    const UsdStageAttribute* colours = find({"primvars:groom_color", "primvars:displayColor"});
    if (!colours || colours->numbers.size() % 3 != 0) return;
    const std::size_t count = colours->numbers.size() / 3;
    const bool isOfPoints = count == pointCount() && colours->interpolation != "uniform";
    if (!isOfPoints && count != strandCount() && count != 1) return;
    UsdStageAttribute all{.name = "primvars:groom_color", .type = "float3[]", .interpolation = "vertex"};
    for (std::size_t s = 0; s < strandCount(); ++s) {
      for (std::size_t i = first_[s] - first_[0]; i < first_[s + 1] - first_[0]; ++i) {
        const double* colour = colours->numbers.data() + 3 * (isOfPoints ? i : count == 1 ? 0 : s);
        all.numbers.insert(all.numbers.end(), colour, colour + 3);
      }
    }
    add(std::move(all));
  }

  void addGroups(const std::vector<std::uint32_t>& groupOf, const std::vector<std::string>& names,
                 std::uint32_t firstStrand) {
    if (groupOf.empty()) return;
    UsdStageAttribute ids{.name = "primvars:groom_group_id", .type = "int[]", .interpolation = "uniform"};
    UsdStageAttribute texts{
        .name = "primvars:groom_group_name", .type = "string[]", .interpolation = "uniform"};
    for (std::size_t s = firstStrand; s < firstStrand + strandCount(); ++s) {
      ids.numbers.push_back(groupOf[s]);
      texts.texts.push_back(names[groupOf[s]]);
    }
    add(std::move(ids));
    add(std::move(texts));
  }

  // 1 of strands that others follow.
  void addGuides(const std::vector<ClosestGuides>& closest, std::uint32_t firstStrand) {
    if (closest.empty()) return;
    UsdStageAttribute guides{.name = "primvars:groom_guide", .type = "int[]", .interpolation = "uniform"};
    for (std::size_t s = firstStrand; s < firstStrand + strandCount(); ++s)
      guides.numbers.push_back(closest[s].strands[0] == s ? 1 : 0);
    add(std::move(guides));
  }

  void addVersion() {
    const auto number = [](const char* name, double value) {
      return UsdStageAttribute{.name = name, .type = "int", .numbers = {value}};
    };
    add(number("userProperties:groom_version_major", 1));
    add(number("userProperties:groom_version_minor", 5));
    add({.name = "userProperties:groom_tool", .type = "string", .texts = {"Ringlet"}});
  }

 private:
  std::size_t strandCount() const { return first_.size() - 1; }
  std::size_t pointCount() const { return first_.back() - first_.front(); }

  const UsdStageAttribute* find(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names) {
      const auto found = std::ranges::find(said_, name, &UsdStageAttribute::name);
      if (found != said_.end()) return &*found;
    }
    return nullptr;
  }
  // In front of what moves, which stands last.
  void add(UsdStageAttribute value) {
    auto& all = prim_.attributes;
    if (std::ranges::find(all, value.name, &UsdStageAttribute::name) != all.end()) return;
    all.insert(std::ranges::find_if(all, [](const auto& a) { return a.elementsOfSample > 0; }),
               std::move(value));
  }

  std::span<const std::uint32_t> first_;  // point of each strand, and one more
  const std::vector<UsdStageAttribute>& said_;
  UsdStagePrim& prim_;
};

}  // namespace

void addUnreal(const Groom& topology, const HairCurves& curves, const UsdExtras& extras,
               const std::vector<UsdStageAttribute>& said, UsdStagePrim& prim) {
  prim.apiSchemas = {"GroomAPI"};
  UnrealValues values(topology, curves, said, prim);
  values.widen();
  values.addGroups(extras.groupOf, extras.groupNames, curves.firstStrand);
  values.addGuides(extras.closestGuides, curves.firstStrand);
  values.carry();
  values.addIds(curves.firstStrand);
  values.addRootUvs();
  values.addColours();
  values.addVersion();
}

}  // namespace ringlet
