// Implements scene/settings_fields.h.
#include "ringlet/scene/settings_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace ringlet {
namespace {

constexpr NumberRange kSeed{0, 4294967295.0};
constexpr NumberRange kShare{0, 1};
constexpr double kMostOverlaps = 1e6;

// What a setting holds, number by number, each with what comes behind its name.
using Numbers = std::vector<std::pair<const char*, double>>;
Numbers numbersOf(const auto&) { return {}; }
Numbers numbersOf(double value) { return {{"", value}}; }
Numbers numbersOf(int value) { return {{"", double(value)}}; }
Numbers numbersOf(std::uint32_t value) { return {{"", double(value)}}; }
Numbers numbersOf(Vec3d v) { return {{".x", v.x}, {".y", v.y}, {".z", v.z}}; }
template <class T>
Numbers numbersOf(const std::optional<T>& value) {
  return value ? numbersOf(*value) : Numbers{};
}

template <class Owner>
Status check(std::span<const SettingField<Owner>> fields, const Owner& settings, const char* table) {
  for (const SettingField<Owner>& field : fields) {
    const Numbers numbers =
        std::visit([&](auto member) { return numbersOf(settings.*member); }, field.member);
    for (const auto& [part, value] : numbers) {
      if (!field.allowed.contains(value))
        return Error{fmt::format("{}{}{} is {}; it must be from {} to {}", table, field.key, part, value,
                                 field.allowed.low, field.allowed.high)};
    }
  }
  return {};
}

template <class Owner>
std::string differenceOf(std::span<const SettingField<Owner>> fields, const Owner& a, const Owner& b,
                         const char* table) {
  for (const SettingField<Owner>& field : fields) {
    const bool isEqual = std::visit([&](auto member) { return a.*member == b.*member; }, field.member);
    if (!isEqual && !field.isLive) return fmt::format("{}{}", table, field.key);
  }
  return "";
}

}  // namespace

std::vector<std::string> namesIn(std::string_view list) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t comma = std::min(list.find(", ", at), list.size());
    names.emplace_back(list.substr(at, comma - at));
    at = comma + 2;
  }
  return names;
}

std::span<const SettingField<Settings>> settingsFields() {
  using S = Settings;
  using F = SettingField<S>;
  static const F all[] = {
      F{"fps", "1/s", "", "Frames per second.", &S::framesPerSecond, {0.001, 1e6}}.live(),
      F{"steps_per_frame", "", "", "Outer steps a frame.", &S::stepsPerFrame, {1, kMostStepsPerFrame}}.live(),
      F{"gravity", "m/s^2", "", "What everything falls with.", &S::gravity, {-1e4, 1e4}}.live(),
      F{"preload", "1", "", "Share of gravity balanced in the rest pose.", &S::gravityPreload, kShare},
      F{"max_stretch",
        "1",
        "",
        "Longest an edge may become, as a multiple of the groom's edge.",
        &S::maxStretch,
        {1, 100}}
          .live(),
      F{"teleport_distance",
        "m",
        "",
        "A head that jumps further in one frame carries the hair along rigidly; 0: never.",
        &S::teleportDistance,
        {0, 1e6}}
          .live(),
      F{"sleep_speed",
        "m/s",
        "",
        "Hair that is slower than this everywhere for some frames, while nothing acts on it anew, is not "
        "stepped "
        "until something does; 0: never. Not of the reference.",
        &S::sleepSpeed,
        {0, 1}}
          .live(),
      F{"roots", "", "", "Particles at the root that follow the head.", &S::rootCount, {1, kMostRoots}},
      F{"iterations", "", "", "Of a step.", &S::pointIterations, {1, 60000}, "", "point_jacobi"}.live(),
      F{"chebyshev", "", "", "Whether these are accelerated.", &S::chebyshev, {}, "", "point_jacobi"}.live(),
      F{"force_loops", "", "", "Of a step.", &S::forceLoops, {1, 1000}, "", "paper"}.live(),
      F{"damping_loops", "", "", "Of a force loop.", &S::dampingLoops, {1, 1000}, "", "paper"}.live(),
  };
  return all;
}

std::span<const SettingField<ContactSettings>> contactFields() {
  using C = ContactSettings;
  using F = SettingField<C>;
  static const F all[] = {
      F{"on", "", "true where [contacts] stands", "Whether strands push each other away; jacobi only.",
        &C::on},
      F{"method",
        "",
        "",
        "By what means: auto, as a volume where strands are dense at rest and pair by pair elsewhere; pair "
        "by "
        "pair; or all as a volume.",
        &C::method,
        {},
        "auto, explicit, volume"},
      F{"radius",
        "m",
        "half the mean distance of neighbouring roots",
        "Radius of the spheres by which strands feel each other.",
        &C::radius,
        {1e-6, 1}}
          .asOption("--contact-radius"),
      F{"fill_gaps", "", "",
        "Whether strands whose particles stand further apart than two radii get a larger radius, so that "
        "nothing slips between; in a dense groom slow.",
        &C::fillGaps}
          .asOption("--fill-gaps"),
      F{"spacing",
        "1",
        "",
        "Spheres stand this share of two radii apart along a strand: less keeps more of them.",
        &C::spacing,
        {0.01, 1}},
      F{"detail",
        "1",
        "",
        "Share of their contact particles by which strands that are dense at rest meet others pair by pair: "
        "with 0.5 a frame of dense hair takes less than half as long, and more of it slips through.",
        &C::detail,
        {0.05, 1}}
          .asOption("--contact-detail"),
      F{"prune_pairs", "", "", "Whether only strands that are near at rest may touch.", &C::prunePairs},
      F{"enlargement",
        "1",
        "",
        "Factor on radii while overlaps at rest are counted.",
        &C::enlargement,
        {1, 100}},
      F{"min_overlaps",
        "",
        "",
        "Overlapping spheres at rest from which on two strands may touch.",
        &C::minOverlaps,
        {1, kMostOverlaps}},
      F{"max_neighbours",
        "",
        "",
        "Most strands that one may touch, those with the most overlaps; 0: no bound.",
        &C::maxNeighbours,
        {0, kMostOverlaps}}
          .asOption("--max-neighbours"),
      F{"drop_share", "1", "", "Share of the pairs of strands then left that is dropped at random.",
        &C::dropShare, kShare}
          .asOption("--drop-share"),
      F{"seed", "", "", "Of drop_share and detail.", &C::seed, kSeed},
      F{"stiffness",
        "w / R",
        "",
        "Of two spheres that touch: the weight of one over the sum of their radii.",
        &C::stiffness,
        {0, 1e7}}
          .live(),
      F{"damping_ratio", "1", "", "Along the contact's normal; 1 is critical.", &C::dampingRatio, {0, 100}}
          .live(),
      F{"friction", "1", "",
        "Damping of strands that slide along each other, pair by pair, as a share of that between strands "
        "that meet.",
        &C::friction, kShare}
          .asOption("--contact-friction")
          .live(),
      F{"taper",
        "",
        "",
        "How a contact comes and goes: with the distance of the two, or in time, as in the paper, which is "
        "slower and pair by pair.",
        &C::taper,
        {},
        "distance, time"}
          .asOption("--contact-taper"),
      F{"ramp_seconds", "s", "", "From first touch to full stiffness.", &C::rampSeconds, {0, 10}, "", "time"}
          .live(),
      F{"stiffness_release_seconds",
        "s",
        "",
        "From parting until stiffness has faded.",
        &C::stiffnessReleaseSeconds,
        {0, 10},
        "",
        "time"}
          .live(),
      F{"damping_release_seconds",
        "s",
        "",
        "And then damping.",
        &C::dampingReleaseSeconds,
        {0, 10},
        "",
        "time"}
          .live(),
      F{"break_factor",
        "1",
        "",
        "Parted further than this times its rest length, a contact is over.",
        &C::breakFactor,
        {1, 10},
        "",
        "time"},
      F{"volume_cell",
        "m",
        "four radii, or more where particles are further apart",
        "Cell of the grid by which hair meets as a volume: how far a strand feels what is about it.",
        &C::volumeCell,
        {1e-5, 10}}
          .asOption("--volume-cell"),
      F{"volume_drag",
        "1/s",
        "",
        "Of hair that meets as a volume, towards the velocity of what is near.",
        &C::volumeDrag,
        {0, 1e5}}
          .live(),
      F{"volume_stiffness", "1/s^2", "", "And towards its displacement.", &C::volumeStiffness, {0, 1e9}}
          .live(),
      F{"volume_memory_seconds",
        "s",
        "",
        "In which such a displacement is forgotten.",
        &C::volumeMemorySeconds,
        {0.001, 1000}}
          .live(),
      F{"iterations",
        "",
        "2; 1 where all hair meets as a volume",
        "Solves of a step in which strands hear of each other: more is slower and loses less momentum.",
        &C::iterations,
        {1, 1000}}
          .asOption("--contact-iterations")
          .live(),
  };
  return all;
}

std::span<const SettingField<AirSettings>> airFields() {
  using A = AirSettings;
  using F = SettingField<A>;
  static const F all[] = {
      F{"on", "", "true where [air] stands", "Whether there is air; jacobi only.", &A::on},
      F{"fall_speed",
        "m/s",
        "",
        "At which air carries hair's weight: less, and wind takes more.",
        &A::fallSpeed,
        {0.01, 1000}}
          .live(),
      F{"along_share", "1", "", "What air does along a strand, as a share of what it does across.",
        &A::alongShare, kShare}
          .live(),
      F{"wind", "m/s", "", "Even wind.", &A::wind, {-1000, 1000}}.live(),
      F{"gust", "1", "", "The wind swells by up to this share of itself.", &A::gust, {0, 10}}.live(),
      F{"gust_seconds", "s", "", "From gust to gust, on average.", &A::gustSeconds, {0.01, 1000}}.live(),
      F{"turbulence",
        "m/s",
        "",
        "Root mean square of each component of the turbulent wind.",
        &A::turbulence,
        {0, 1000}},
      F{"eddy_size", "m", "", "Of its largest eddies.", &A::eddySize, {0.001, 1000}},
      F{"seed", "", "", "Of gusts and turbulence.", &A::seed, kSeed},
  };
  return all;
}

Status checkNumbers(const ContactSettings& settings) { return check(contactFields(), settings, "contacts."); }
Status checkNumbers(const Settings& settings) {
  if (Status status = check(settingsFields(), settings, ""); !status) return status;
  if (Status status = checkNumbers(settings.contacts); !status) return status;
  return check(airFields(), settings.air, "air.");
}

std::string fixedDifference(const Settings& a, const Settings& b) {
  if (a.integrator != b.integrator) return "integrator";
  std::string name = differenceOf(settingsFields(), a, b, "");
  if (name.empty()) name = fixedDifference(a.contacts, b.contacts);
  return name.empty() ? fixedDifference(a.air, b.air) : name;
}
std::string fixedDifference(const ContactSettings& a, const ContactSettings& b) {
  return differenceOf(contactFields(), a, b, "contacts.");
}
std::string fixedDifference(const AirSettings& a, const AirSettings& b) {
  return differenceOf(airFields(), a, b, "air.");
}

}  // namespace ringlet
