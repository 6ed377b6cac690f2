// What many heads of one asset take for a frame: one by one, together in one submission, and, for comparison,
// as many strands on one head. Verified before it is timed: each head together with the others has the bits
// it has alone. Run: build/release/bench/heads_bench [HEADS [STRANDS [PARTICLES]]] [--json]
#include <fmt/format.h>

#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bench/clocks.h"
#include "ringlet/groom/generate.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/hair_frames.h"

namespace {

using namespace ringlet;

constexpr int kVerified = 3, kWarm = 3, kTimed = 15;  // frames

// Each head on a way of its own.
std::vector<HeadPose> posesOf(std::size_t head, int frame) {
  const Settings settings;
  std::vector<HeadPose> poses;
  for (int k = 1; k <= settings.stepsPerFrame; ++k) {
    const double t = (frame + double(k) / settings.stepsPerFrame) / settings.framesPerSecond;
    poses.push_back({Vec3d{0.3 * t, 0.001 * double(head) * t, 0}, fromRotationVector(Vec3d{0, 2 * t, 0})});
  }
  return poses;
}

Status stepEach(std::vector<Simulation>& heads, int frame) {
  for (std::size_t k = 0; k < heads.size(); ++k)
    if (Status status = heads[k].stepFrame(posesOf(k, frame)); !status) return status;
  return {};
}
Status stepTogether(std::vector<Simulation>& heads, int frame) {
  std::vector<std::vector<HeadPose>> poses;
  std::vector<HairFrame> frames;
  for (std::size_t k = 0; k < heads.size(); ++k) poses.push_back(posesOf(k, frame));
  for (std::size_t k = 0; k < heads.size(); ++k) frames.push_back({&heads[k], poses[k]});
  return stepFrames(frames);
}

struct Time {
  double wall = 0, cpu = 0;  // [ms] of a frame
  double ratio = 0;          // wall time by that of the last way
};
using Step = std::function<Status(int frame)>;

// Each way in turn, frame by frame; medians.
Result<std::vector<Time>> timeInTurn(const std::vector<Step>& ways) {
  std::vector<std::vector<double>> wall(ways.size()), cpu(ways.size());
  for (int frame = kVerified; frame < kVerified + kWarm + kTimed; ++frame) {
    for (std::size_t w = 0; w < ways.size(); ++w) {
      const double wallStart = bench::wallSeconds(), cpuStart = bench::processCpuSeconds();
      if (Status status = ways[w](frame); !status) return status.error();
      if (frame < kVerified + kWarm) continue;
      wall[w].push_back(1e3 * (bench::wallSeconds() - wallStart));
      cpu[w].push_back(1e3 * (bench::processCpuSeconds() - cpuStart));
    }
  }
  std::vector<Time> times;
  for (std::size_t w = 0; w < ways.size(); ++w)
    times.push_back(
        {bench::median(wall[w]), bench::median(cpu[w]), bench::medianRatio(wall[w], wall.back())});
  return times;
}

Result<std::vector<Simulation>> makeHeads(const HairAsset& asset, int count) {
  std::vector<Simulation> heads;
  for (int k = 0; k < count; ++k) {
    auto made = Simulation::create(asset);
    if (!made) return made.error();
    heads.push_back(std::move(*made));
  }
  return heads;
}

Result<HairAsset> assetOf(const ComputeDevice& device, int strands, int particles, int heads) {
  HeadParameters parameters;
  parameters.strandCount = strands;
  parameters.curl.particleCount = particles;
  const auto groom = makeHead(parameters);
  return groom ? HairAsset::build(device, *groom, {}, {}, {.heads = heads}) : groom.error();
}

struct Figures {
  std::string device, kernel, wholeKernel;
  double created = 0;       // another head [ms]
  std::vector<Time> times;  // as kWays
};
constexpr const char* kWays[] = {"one by one", "together", "one groom"};

struct Asked {
  int headCount = 100, strands = 100, particles = 32;
};

void print(const Asked& asked, const Figures& found) {
  fmt::print("{} heads of {} x {} on {}, {}; one of {} x {}, {}\n", asked.headCount, asked.strands,
             asked.particles, found.device, found.kernel, asked.strands * asked.headCount, asked.particles,
             found.wholeKernel);
  fmt::print("  each head is, bit for bit, where it is alone; another head takes {:.2f} ms to make\n",
             found.created);
  fmt::print("  frame of all       wall [ms]   CPU [ms]   wall by one groom's\n");
  for (std::size_t w = 0; w < found.times.size(); ++w)
    fmt::print("  {:<16} {:10.1f} {:10.1f} {:12.2f}\n", kWays[w], found.times[w].wall, found.times[w].cpu,
               found.times[w].ratio);
}

void printJson(const Asked& asked, const Figures& found) {
  nlohmann::ordered_json json{{"heads", asked.headCount},        {"strands", asked.strands},
                              {"particles", asked.particles},    {"device", found.device},
                              {"kernel", found.kernel},          {"one_groom_kernel", found.wholeKernel},
                              {"ms_to_make_head", found.created}};
  for (std::size_t w = 0; w < found.times.size(); ++w)
    json["frame_of_all"].push_back({{"way", kWays[w]},
                                    {"wall_ms", found.times[w].wall},
                                    {"cpu_ms", found.times[w].cpu},
                                    {"wall_by_one_groom", found.times[w].ratio}});
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

Result<Figures> measure(const Asked& asked) {
  const auto [headCount, strands, particles] = asked;
  const auto device = ComputeDevice::open();
  if (!device) return device.error();
  const auto asset = assetOf(*device, strands, particles, headCount);
  if (!asset) return asset.error();
  const auto whole = assetOf(*device, strands * headCount, particles, 1);
  if (!whole) return whole.error();
  auto alone = makeHeads(*asset, headCount);
  if (!alone) return alone.error();
  double start = bench::wallSeconds();
  auto together = makeHeads(*asset, headCount);
  if (!together) return together.error();
  const double created = 1e3 * (bench::wallSeconds() - start) / headCount;
  auto one = makeHeads(*whole, 1);
  if (!one) return one.error();

  for (int frame = 0; frame < kVerified; ++frame) {
    if (Status status = stepEach(*alone, frame); !status) return status.error();
    if (Status status = stepTogether(*together, frame); !status) return status.error();
    if (Status status = stepEach(*one, frame); !status) return status.error();
  }
  for (int k = 0; k < headCount; ++k) {
    if ((*alone)[k].framePositions() != (*together)[k].framePositions())
      return Error{fmt::format("head {} is elsewhere together with the others", k)};
  }

  const auto times = timeInTurn({[&](int frame) { return stepEach(*alone, frame); },
                                 [&](int frame) { return stepTogether(*together, frame); },
                                 [&](int frame) { return stepEach(*one, frame); }});
  if (!times) return times.error();
  return Figures{device->name(), Diagnostics(together->front()).kernels(),
                 Diagnostics(one->front()).kernels(), created, *times};
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<int> numbers;
  bool isJson = false;
  for (int i = 1; i < count; ++i) {
    if (std::string_view(arguments[i]) == "--json") {
      isJson = true;
    } else {
      numbers.push_back(std::atoi(arguments[i]));
    }
  }
  const auto number = [&](std::size_t i, int otherwise) {
    return numbers.size() > i ? numbers[i] : otherwise;
  };
  const Asked asked{number(0, 100), number(1, 100), number(2, 32)};
  const auto found = measure(asked);
  if (!found) {
    fmt::print(stderr, "heads_bench: {}\n", found.error().message);
    return 1;
  }
  isJson ? printJson(asked, *found) : print(asked, *found);
  return 0;
}
