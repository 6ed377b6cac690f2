// Implements scene/settings_fields.h, but for the table of contacts, which is in contact_fields.cpp.
#include "ringlet/scene/settings_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "ringlet/scene/setting_check.h"

namespace ringlet {
namespace {

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
      F{"gravity", "m/s^2", "", "Acceleration of gravity.", &S::gravity, {-1e4, 1e4}}.live(),
      F{"preload", "1", "", "Share of gravity balanced in the rest pose.", &S::gravityPreload, kShareRange},
      F{"max_stretch",
        "1",
        "",
        "Stretch limit: largest length of an edge as a multiple of its length in the groom.",
        &S::maxStretch,
        {1, 100}}
          .live(),
      F{"teleport_distance",
        "m",
        "",
        "A head that moves farther than this in one frame carries the hair along rigidly; 0: never.",
        &S::teleportDistance,
        {0, 1e6}}
          .live(),
      F{"sleep_speed",
        "m/s",
        "",
        "Hair slower than this for 8 frames sleeps: it is not stepped until its head, bodies, air, forces or "
        "settings change; 0: never. The reference ignores it.",
        &S::sleepSpeed,
        {0, 1}}
          .live(),
      F{"roots",
        "",
        "",
        "Particles at the root of a strand that follow the head.",
        &S::rootCount,
        {1, kMostRoots}},
      F{"iterations",
        "",
        "",
        "Number of iterations a step.",
        &S::pointIterations,
        {1, 60000},
        "",
        "point_jacobi"}
          .live(),
      F{"chebyshev",
        "",
        "",
        "Whether the iterations are Chebyshev-accelerated.",
        &S::chebyshev,
        {},
        "",
        "point_jacobi"}
          .live(),
      F{"force_loops", "", "", "Force loops a step.", &S::forceLoops, {1, 1000}, "", "paper"}.live(),
      F{"damping_loops", "", "", "Damping loops a force loop.", &S::dampingLoops, {1, 1000}, "", "paper"}
          .live(),
  };
  return all;
}

std::span<const SettingField<AirSettings>> airFields() {
  using A = AirSettings;
  using F = SettingField<A>;
  static const F all[] = {
      F{"on", "", "true where [air] stands", "Whether there is air. Needs jacobi.", &A::on},
      F{"fall_speed",
        "m/s",
        "",
        "Terminal speed of a falling horizontal strand. A lower speed means more drag.",
        &A::fallSpeed,
        {0.01, 1000}}
          .live(),
      F{"along_share", "1", "", "Drag along a strand, as a share of the drag across it.", &A::alongShare,
        kShareRange}
          .live(),
      F{"wind", "m/s", "", "Uniform wind.", &A::wind, {-1000, 1000}}.live(),
      F{"gust", "1", "", "Largest increase of the wind in a gust, as a share of the wind.", &A::gust, {0, 10}}
          .live(),
      F{"gust_seconds", "s", "", "Mean time between gusts.", &A::gustSeconds, {0.01, 1000}}.live(),
      F{"turbulence",
        "m/s",
        "",
        "Root mean square of each component of the turbulent wind.",
        &A::turbulence,
        {0, 1000}},
      F{"eddy_size", "m", "", "Size of the largest eddies of the turbulence.", &A::eddySize, {0.001, 1000}},
      F{"seed", "", "", "Seed of gusts and turbulence.", &A::seed, kSeedRange},
  };
  return all;
}

std::span<const SettingField<GoalSettings>> goalFields() {
  using G = GoalSettings;
  using F = SettingField<G>;
  static const F all[] = {
      F{"on", "", "true where [goal] stands",
        "Whether hair is pulled to the groom, carried by the head. Needs jacobi.", &G::on},
      F{"strength",
        "1",
        "",
        "Pull at the root: weights of the hair a centimetre from its place. 0.1 is a hint, 10 holds firmly.",
        &G::strength,
        {0, 1e7}}
          .live(),
      F{"tip_share",
        "1",
        "",
        "Pull at the tip, as a share of that at the root; evenly between.",
        &G::tipShare,
        {0, 100}}
          .live(),
      F{"damping", "1", "", "Damping ratio of hair about its place; 1 is critical.", &G::damping, {0, 100}}
          .live(),
      F{"shape", "", "false",
        "Whether the goal is how hair lies and not where it is: the direction of every edge. A strength is "
        "then in the strand's weight, as bend_stiffness is.",
        &G::shape},
  };
  return all;
}

Status checkNumbers(const ContactSettings& settings) {
  return checkRows(contactFields(), settings, "contacts.");
}
Status checkNumbers(const Settings& settings) {
  if (Status status = checkRows(settingsFields(), settings, ""); !status) return status;
  if (Status status = checkNumbers(settings.contacts); !status) return status;
  if (Status status = checkRows(airFields(), settings.air, "air."); !status) return status;
  return checkRows(goalFields(), settings.goal, "goal.");
}

std::string fixedDifference(const Settings& a, const Settings& b) {
  if (a.integrator != b.integrator) return "integrator";
  std::string name = differenceOf(settingsFields(), a, b, "");
  if (name.empty()) name = fixedDifference(a.contacts, b.contacts);
  if (name.empty()) name = fixedDifference(a.air, b.air);
  return name.empty() ? fixedDifference(a.goal, b.goal) : name;
}
std::string fixedDifference(const ContactSettings& a, const ContactSettings& b) {
  return differenceOf(contactFields(), a, b, "contacts.");
}
std::string fixedDifference(const AirSettings& a, const AirSettings& b) {
  return differenceOf(airFields(), a, b, "air.");
}
std::string fixedDifference(const GoalSettings& a, const GoalSettings& b) {
  return differenceOf(goalFields(), a, b, "goal.");
}

}  // namespace ringlet
