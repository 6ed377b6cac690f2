// Calls of the C interface at a wrong time, in a wrong process, with numbers that hair cannot have, with
// callbacks that throw: each is answered, and the host lives on. The tests go through all functions, numbers
// and callbacks there are.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <random>
#include <regex>
#include <set>
#include <stdexcept>

#include "ringlet/base/whole_file.h"
#include "ringlet/gpu/owned.h"
#include "ringlet/scene/body_forms.h"
#include "ringlet/scene/force_field.h"
#include "tests/kernels/c_handles.h"
#include "tests/support/parity.h"

namespace ringlet::test::c_wrong_calls_test {
namespace {

using CWrongCalls = CTest;

constexpr std::uint32_t kParticles = 21;

// Hair for which every function is built.
struct Built : Handles {
  Groom groom = randomGroom({12, 9}, 3);
  CGroom from{groom};
  void build(std::uint32_t hairCount = 1) {
    ringlet_asset_options options = RINGLET_INIT(ringlet_asset_options);
    options.features = RINGLET_BODIES | RINGLET_ROOTS | RINGLET_FORCES | RINGLET_GOALS | RINGLET_FIELDS;
    ASSERT_EQ(ringlet_asset_build(device, &from.groom, settings, material, &options, &asset), RINGLET_OK)
        << ringlet_error_message();
    for (std::uint32_t k = 0; k < hairCount; ++k)
      ASSERT_EQ(ringlet_hair_create(asset, nullptr, &hairs.emplace_back()), RINGLET_OK)
          << ringlet_error_message();
  }
};

// What a function needs of the hair that it takes.
enum class Needs { nothing, process, framesOver };
struct Call {
  const char* function;
  Needs needs;
  std::function<ringlet_result(ringlet_hair*)> run;
};

// Every function that takes hair, with right arguments.
std::vector<Call> callsOf(const Built& c, const std::vector<std::byte>& checkpoint, void* commands) {
  static std::vector<float> xyz(3 * kParticles), strengths(kParticles, 1.0f);
  static std::vector<ringlet_pose> poses(8);
  static const ringlet_pose head{};
  static const ringlet_cut cut{0, 5};
  static std::vector<std::byte> room;
  static const auto frameOf = [](ringlet_hair* hair) {
    ringlet_frame frame = RINGLET_INIT(ringlet_frame);
    frame.hair = hair, frame.step_poses = poses.data(), frame.step_count = 8;
    return frame;
  };
  return {
      {"ringlet_hair_release", Needs::nothing, [](ringlet_hair*) { return RINGLET_OK; }},  // at the end
      {"ringlet_step", Needs::framesOver,
       [](ringlet_hair* hair) {
         const ringlet_frame frame = frameOf(hair);
         return ringlet_step(&frame, 1);
       }},
      {"ringlet_step_to", Needs::framesOver, [](ringlet_hair* hair) { return ringlet_step_to(hair, &head); }},
      {"ringlet_record", Needs::process,
       [=](ringlet_hair* hair) {
         const ringlet_frame frame = frameOf(hair);
         return ringlet_record(&frame, 1, commands);
       }},
      {"ringlet_positions", Needs::framesOver,
       [](ringlet_hair* hair) { return ringlet_positions(hair, xyz.data(), kParticles); }},
      {"ringlet_velocities", Needs::framesOver,
       [](ringlet_hair* hair) { return ringlet_velocities(hair, xyz.data(), kParticles); }},
      {"ringlet_device_positions_count", Needs::nothing,
       [](ringlet_hair* hair) {
         return ringlet_device_positions_count(hair) == 1 ? RINGLET_OK : RINGLET_ERROR;
       }},
      {"ringlet_get_device_positions", Needs::process,
       [](ringlet_hair* hair) {
         ringlet_device_positions positions = RINGLET_INIT(ringlet_device_positions);
         return ringlet_get_device_positions(hair, 0, &positions);
       }},
      {"ringlet_hair_set_settings", Needs::framesOver,
       [&c](ringlet_hair* hair) { return ringlet_hair_set_settings(hair, c.settings); }},
      {"ringlet_hair_set_material", Needs::framesOver,
       [&c](ringlet_hair* hair) { return ringlet_hair_set_material(hair, c.material); }},
      {"ringlet_hair_prepare", Needs::framesOver,
       [](ringlet_hair* hair) { return ringlet_hair_prepare(hair, RINGLET_FIELDS); }},
      {"ringlet_hair_set_bodies", Needs::framesOver,
       [](ringlet_hair* hair) { return ringlet_hair_set_bodies(hair, nullptr, 0); }},
      {"ringlet_hair_set_forces", Needs::process,
       [](ringlet_hair* hair) { return ringlet_hair_set_forces(hair, xyz.data(), kParticles); }},
      {"ringlet_hair_set_goals", Needs::process,
       [](ringlet_hair* hair) {
         ringlet_goals goals = RINGLET_INIT(ringlet_goals);
         goals.places = xyz.data(), goals.strengths = strengths.data(), goals.particle_count = kParticles;
         return ringlet_hair_set_goals(hair, &goals);
       }},
      {"ringlet_hair_set_fields", Needs::process,
       [](ringlet_hair* hair) { return ringlet_hair_set_fields(hair, nullptr, nullptr, 0); }},
      {"ringlet_get_report", Needs::framesOver,
       [](ringlet_hair* hair) {
         ringlet_report report = RINGLET_INIT(ringlet_report);
         return ringlet_get_report(hair, &report);
       }},
      {"ringlet_checkpoint", Needs::framesOver,
       [&](ringlet_hair* hair) {
         std::size_t size = 0;
         return ringlet_checkpoint(hair, nullptr, &size);
       }},
      {"ringlet_restore", Needs::framesOver,
       [&checkpoint](ringlet_hair* hair) {
         return ringlet_restore(hair, checkpoint.data(), checkpoint.size());
       }},
      {"ringlet_hair_cut", Needs::framesOver,
       [](ringlet_hair* hair) { return ringlet_hair_cut(hair, &cut, 1); }},
      // At the end: afterwards the frame is over.
      {"ringlet_frame_is_over", Needs::process,
       [](ringlet_hair* hair) { return ringlet_frame_is_over(hair); }},
  };
}

std::vector<std::byte> checkpointOf(ringlet_hair* hair) {
  std::size_t size = 0;
  EXPECT_EQ(ringlet_checkpoint(hair, nullptr, &size), RINGLET_OK) << ringlet_error_message();
  std::vector<std::byte> bytes(size);
  EXPECT_EQ(ringlet_checkpoint(hair, bytes.data(), &size), RINGLET_OK);
  return bytes;
}

// A command buffer of a host's on the same device.
class HostCommands {
 public:
  explicit HostCommands(gpu::Device& device) : device_(device) {
    VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0,
                                     device.queueFamily()};
    VkCommandPool pool = VK_NULL_HANDLE;
    EXPECT_EQ(device.vk().vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pool), VK_SUCCESS);
    pool_ = gpu::OwnedCommandPool(device.shared_from_this(), pool);
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool,
                                     VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    EXPECT_EQ(device.vk().vkAllocateCommandBuffers(device.handle(), &info, &commands_), VK_SUCCESS);
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, 0, nullptr};
    EXPECT_EQ(device.vk().vkBeginCommandBuffer(commands_, &begin), VK_SUCCESS);
  }
  void* handle() const { return commands_; }
  void run() {
    EXPECT_EQ(device_.vk().vkEndCommandBuffer(commands_), VK_SUCCESS);
    EXPECT_EQ(device_.submit(std::span(&commands_, 1), VK_NULL_HANDLE), VK_SUCCESS);
    EXPECT_EQ(device_.vk().vkDeviceWaitIdle(device_.handle()), VK_SUCCESS);
  }

 private:
  gpu::Device& device_;
  gpu::OwnedCommandPool pool_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

TEST_F(CWrongCalls, TheListHasEveryFunctionThatTakesHair) {
  const auto file = readWholeFile(std::filesystem::path(RINGLET_SOURCE_DIR) / "src/ringlet/c/ringlet.h");
  ASSERT_TRUE(file);
  const std::string text(reinterpret_cast<const char*>(file->data()), file->size());
  const std::regex declaration(R"((ringlet_\w+)\(([^)]*)\);)");
  std::set<std::string> inHeader, inList;
  for (std::sregex_iterator at(text.begin(), text.end(), declaration), end; at != end; ++at) {
    const std::string arguments = (*at)[2];
    const bool takesHair = std::regex_search(arguments, std::regex(R"(ringlet_(hair|frame)\* )"));
    if (takesHair) inHeader.insert((*at)[1]);
  }
  const Built none;
  for (const Call& call : callsOf(none, {}, nullptr)) inList.insert(call.function);
  EXPECT_EQ(inHeader, inList);
}

TEST_F(CWrongCalls, WhileAFrameIsInAHostsCommands) {
  Built c;
  open(c);
  c.build(2);
  const std::vector<std::byte> checkpoint = checkpointOf(c.hairs[0]);
  HostCommands commands(gpu());
  std::vector<ringlet_pose> poses(8);
  ringlet_frame frame = RINGLET_INIT(ringlet_frame);
  frame.hair = c.hairs[0], frame.step_poses = poses.data(), frame.step_count = 8;
  ASSERT_EQ(ringlet_record(&frame, 1, commands.handle()), RINGLET_OK) << ringlet_error_message();
  for (const Call& call : callsOf(c, checkpoint, commands.handle())) {
    if (std::string(call.function) == "ringlet_frame_is_over") commands.run();
    const ringlet_result result = call.run(c.hairs[0]);
    if (call.needs == Needs::framesOver) {
      EXPECT_EQ(result, RINGLET_ERROR_INVALID_ARGUMENT) << call.function;
      EXPECT_NE(std::string(ringlet_error_message()).find("ringlet_frame_is_over"), std::string::npos)
          << call.function << ": " << ringlet_error_message();
    } else {
      EXPECT_EQ(result, RINGLET_OK) << call.function << ": " << ringlet_error_message();
    }
  }
  // The second frame that was recorded.
  ASSERT_EQ(ringlet_frame_is_over(c.hairs[0]), RINGLET_OK) << ringlet_error_message();
  for (const Call& call : callsOf(c, checkpoint, commands.handle())) {
    if (std::string(call.function) == "ringlet_record") continue;
    EXPECT_EQ(call.run(c.hairs[0]), RINGLET_OK) << call.function << ": " << ringlet_error_message();
  }
}

// In the child; its status is the number of the first call that was not answered as it must be.
int answersInAnotherProcess(const std::vector<Call>& calls, ringlet_hair* hair) {
  alarm(60);  // a wait that never ends
  for (std::size_t k = 0; k < calls.size(); ++k) {
    const ringlet_result result = calls[k].run(hair);
    const bool isRefused = result == RINGLET_ERROR &&
                           std::string(ringlet_error_message()).find("after fork()") != std::string::npos;
    if (calls[k].needs == Needs::nothing ? result != RINGLET_OK : !isRefused) return static_cast<int>(k) + 1;
  }
  return 0;
}

TEST_F(CWrongCalls, InAProcessThatForkMade) {
  Built c;
  open(c);
  c.build(2);
  const ringlet_pose head{};
  ASSERT_EQ(ringlet_step_to(c.hairs[0], &head), RINGLET_OK);
  const std::vector<std::byte> checkpoint = checkpointOf(c.hairs[0]);
  const HostCommands commands(gpu());
  std::vector<Call> calls = callsOf(c, checkpoint, commands.handle());
  calls.push_back({"ringlet_hair_create", Needs::process, [&](ringlet_hair*) {
                     ringlet_hair* made = nullptr;
                     return ringlet_hair_create(c.asset, nullptr, &made);
                   }});
  calls.push_back({"ringlet_asset_build", Needs::process, [&](ringlet_hair*) {
                     ringlet_asset* made = nullptr;
                     return ringlet_asset_build(c.device, &c.from.groom, nullptr, nullptr, nullptr, &made);
                   }});
  // Released, and the last of their device: nothing waits for what is not there.
  calls.push_back({"release", Needs::nothing, [&](ringlet_hair* hair) {
                     ringlet_hair_release(hair);
                     return RINGLET_OK;
                   }});
  const pid_t child = fork();
  if (child == 0) _exit(answersInAnotherProcess(calls, c.hairs[0]));
  ASSERT_GT(child, 0);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
  const int failed = WEXITSTATUS(status);
  EXPECT_EQ(failed, 0) << calls[static_cast<std::size_t>(std::max(0, failed - 1))].function;
  EXPECT_EQ(ringlet_step_to(c.hairs[0], &head), RINGLET_OK) << "the parent goes on";
}

// A number that hair is given, and where it goes.
struct Number {
  const char* name;
  std::function<ringlet_result(Built&, double)> give;
};

template <class Set>
std::function<ringlet_result(Built&, double)> body(Set set) {
  return [set](Built& c, double value) {
    ringlet_body one = RINGLET_INIT(ringlet_body);
    one.shape = "sphere";
    set(one, value);
    return ringlet_hair_set_bodies(c.hairs[0], &one, 1);
  };
}
template <class Set>
std::function<ringlet_result(Built&, double)> goals(Set set) {
  return [set](Built& c, double value) {
    static std::vector<float> places, strengths, before;
    places.assign(3 * kParticles, 0.01f), strengths.assign(kParticles, 1.0f), before = places;
    ringlet_goals one = RINGLET_INIT(ringlet_goals);
    one.places = places.data(), one.strengths = strengths.data(), one.from = before.data();
    one.particle_count = kParticles;
    set(one, places, strengths, before, value);
    return ringlet_hair_set_goals(c.hairs[0], &one);
  };
}
template <class Set>
std::function<ringlet_result(Built&, double)> field(Set set) {
  return [set](Built& c, double value) {
    static float velocities[24] = {};
    static std::vector<ringlet_number> numbers;
    numbers = {{"radial", {1}}, {"drag", {1}}};
    ringlet_field one = RINGLET_INIT(ringlet_field);
    one.numbers = numbers.data(), one.number_count = 2, one.velocities = velocities;
    one.nodes[0] = one.nodes[1] = one.nodes[2] = 2;
    std::fill(std::begin(velocities), std::end(velocities), 0.5f);
    set(one, velocities, value);
    return ringlet_hair_set_fields(c.hairs[0], &one, nullptr, 1);
  };
}
template <class Set>
std::function<ringlet_result(Built&, double)> frame(Set set) {
  return [set](Built& c, double value) {
    std::vector<ringlet_pose> heads(8), roots(16), bodies(8);
    ringlet_frame one = RINGLET_INIT(ringlet_frame);
    one.hair = c.hairs[0], one.step_poses = heads.data(), one.step_count = 8;
    one.root_poses = roots.data(), one.body_poses = bodies.data();
    ringlet_body sphere = RINGLET_INIT(ringlet_body);
    sphere.shape = "sphere";
    EXPECT_EQ(ringlet_hair_set_bodies(c.hairs[0], &sphere, 1), RINGLET_OK);
    set(heads[7], roots[15], bodies[7], value);
    return ringlet_step(&one, 1);
  };
}

std::vector<Number> numbers() {
  std::vector<Number> all{
      {"body.position", body([](auto& b, double v) { b.pose.position[2] = v; })},
      {"body.rotation", body([](auto& b, double v) { b.pose.rotation[1] = v; })},
      {"body.vertices", body([](auto& b, double v) {
         static float vertices[12];
         static const std::uint32_t triangles[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
         const float corners[12] = {0, 0, 0, 0.1f, 0, 0, 0, 0.1f, 0, 0, 0, static_cast<float>(v)};
         std::copy(std::begin(corners), std::end(corners), vertices);
         b.shape = "mesh", b.vertices = vertices, b.vertex_count = 4;
         b.triangles = triangles, b.triangle_count = 4, b.cells = 8;
       })},
      {"body.cells", body([](auto& b, double v) {
         static const float vertices[12] = {0, 0, 0, 0.1f, 0, 0, 0, 0.1f, 0, 0, 0, 0.1f};
         static const std::uint32_t triangles[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
         b.shape = "mesh", b.vertices = vertices, b.vertex_count = 4;
         b.triangles = triangles, b.triangle_count = 4;
         b.cells = v > 2e9 ? 2147483647 : v < -2e9 ? -2147483647 : std::isnan(v) ? -7 : static_cast<int>(v);
       })},
      {"goals.places", goals([](auto&, auto& places, auto&, auto&, double v) { places[7] = float(v); })},
      {"goals.strengths",
       goals([](auto&, auto&, auto& strengths, auto&, double v) { strengths[5] = float(v); })},
      {"goals.from", goals([](auto&, auto&, auto&, auto& before, double v) { before[62] = float(v); })},
      {"goals.damping_ratio", goals([](auto& g, auto&, auto&, auto&, double v) { g.damping_ratio = v; })},
      {"forces",
       [](Built& c, double v) {
         std::vector<float> xyz(3 * kParticles, 1.0f);
         xyz[40] = static_cast<float>(v);
         return ringlet_hair_set_forces(c.hairs[0], xyz.data(), kParticles);
       }},
      {"field.position", field([](auto& f, float*, double v) { f.pose.position[0] = v; })},
      {"field.rotation", field([](auto& f, float*, double v) { f.pose.rotation[3] = v; })},
      {"field.cell", field([](auto& f, float*, double v) { f.cell = v; })},
      {"field.velocities", field([](auto&, float* velocities, double v) { velocities[13] = float(v); })},
      {"frame.step_poses.position", frame([](auto& head, auto&, auto&, double v) { head.position[1] = v; })},
      {"frame.step_poses.rotation", frame([](auto& head, auto&, auto&, double v) { head.rotation[1] = v; })},
      {"frame.root_poses.rotation", frame([](auto&, auto& root, auto&, double v) { root.rotation[0] = v; })},
      {"frame.body_poses.position", frame([](auto&, auto&, auto& pose, double v) { pose.position[1] = v; })},
      {"frame.body_poses.rotation", frame([](auto&, auto&, auto& pose, double v) { pose.rotation[2] = v; })},
      {"step_to",
       [](Built& c, double v) {
         const ringlet_pose head{{v, 0, 0}, {0, 0, 0, 0}};
         return ringlet_step_to(c.hairs[0], &head);
       }},
      {"initial.head",
       [](Built& c, double v) {
         ringlet_initial_state initial = RINGLET_INIT(ringlet_initial_state);
         initial.head.position[0] = v;
         ringlet_hair_release(std::exchange(c.hairs[0], nullptr));
         const ringlet_result result = ringlet_hair_create(c.asset, &initial, &c.hairs[0]);
         if (result != RINGLET_OK) {
           EXPECT_EQ(ringlet_hair_create(c.asset, nullptr, &c.hairs[0]), RINGLET_OK);
         }
         return result;
       }},
  };
  for (const auto& form : bodyForms()) {
    for (const auto& row : bodyNumbers()) {
      if (form.shape == BodyShape::grid || !hasNumber(form, row)) continue;
      const char* key = row.key;
      all.push_back({key, body([key, &form](auto& b, double v) {
                       static ringlet_number number;
                       number = {key, {0.01, v, 0.01}};
                       if (std::string(key) != "half_extents") number.value[0] = v;
                       b.shape = form.name.data(), b.numbers = &number, b.number_count = 1;
                     })});
    }
  }
  for (const auto& row : forceFieldNumbers()) {
    const char* key = row.key;
    all.push_back({key, field([key](auto& f, float*, double v) {
                     static std::vector<ringlet_number> with;
                     with = {{"radial", {1}}, {"drag", {1}}, {key, {v}}};
                     f.numbers = with.data(), f.number_count = 3;
                   })});
  }
  return all;
}

// Either it is refused, or hair has finite places after the next frames.
TEST_F(CWrongCalls, NumbersThatHairCannotHave) {
  Built c;
  open(c);
  c.build();
  const double values[] = {NAN, INFINITY, -INFINITY, -1,    0,      0.1,    1e6,  1e7,
                           1e9, 1e30,     3e38,      1e300, -1e300, 5e-324, 1e-30};
  for (const Number& number : numbers()) {
    int taken = 0;
    for (const double value : values) {
      SCOPED_TRACE(std::string(number.name) + " = " + std::to_string(value));
      const ringlet_result result = number.give(c, value);
      ASSERT_NE(c.hairs[0], nullptr);
      if (result != RINGLET_OK) {
        EXPECT_STRNE(ringlet_error_message(), "");
        continue;
      }
      EXPECT_TRUE(std::isfinite(value)) << "was taken";
      ++taken;
      const ringlet_pose head{};
      for (int k = 0; k < 2; ++k)
        EXPECT_EQ(ringlet_step_to(c.hairs[0], &head), RINGLET_OK) << ringlet_error_message();
      ringlet_report report = RINGLET_INIT(ringlet_report);
      EXPECT_EQ(ringlet_get_report(c.hairs[0], &report), RINGLET_OK);
      EXPECT_EQ(report.nonfinite, 0u) << "was taken, and hair is nowhere";
      ringlet_hair_release(c.hairs[0]);
      ASSERT_EQ(ringlet_hair_create(c.asset, nullptr, &c.hairs[0]), RINGLET_OK) << ringlet_error_message();
    }
    EXPECT_GT(taken, 0) << number.name << " takes nothing";
  }
}

TEST_F(CWrongCalls, WholeNumbersOfAMaterial) {
  Handles c;
  open(c);
  ASSERT_EQ(ringlet_material_set(c.material, "variation.seed", 7), RINGLET_OK);
  for (const double value :
       {double(NAN), double(INFINITY), -double(INFINITY), -1.0, 0.5, 4294967296.0, 1e300})
    expectInvalid(ringlet_material_set(c.material, "variation.seed", value), "takes a whole number");
  EXPECT_EQ(c.material->material.variation.seed, 7u) << "it is as it was";
}

// What a callback throws becomes an error, whatever it is.
TEST_F(CWrongCalls, CallbacksThatThrow) {
  Handles c;
  open(c);
  const Groom groom = randomGroom({12, 9}, 3);
  const CGroom from(groom);
  ASSERT_EQ(ringlet_material_set(c.material, "core_stiffness", 1e6), RINGLET_OK);
  ringlet_asset_options options = RINGLET_INIT(ringlet_asset_options);
  int warnings = 0;
  options.user = &warnings;
  options.warn = [](const char*, void* user) { ++*static_cast<int*>(user); };
  ASSERT_EQ(ringlet_asset_build(c.device, &from.groom, nullptr, c.material, &options, &c.asset), RINGLET_OK);
  ASSERT_GT(warnings, 0) << "there is nothing to throw from";
  const std::pair<void (*)(const char*, void*), ringlet_result> callbacks[] = {
      {[](const char*, void*) { throw 42; }, RINGLET_ERROR},
      {[](const char*, void*) { throw "a text"; }, RINGLET_ERROR},
      {[](const char*, void*) { throw std::runtime_error("a reason"); }, RINGLET_ERROR},
      {[](const char*, void*) { throw std::bad_alloc(); }, RINGLET_ERROR_OUT_OF_MEMORY}};
  for (const auto& [warn, expected] : callbacks) {
    options.warn = warn;
    ringlet_asset* none = nullptr;
    EXPECT_EQ(ringlet_asset_build(c.device, &from.groom, nullptr, c.material, &options, &none), expected);
    EXPECT_EQ(none, nullptr);
    EXPECT_STRNE(ringlet_error_message(), "");
  }
}

TEST_F(CWrongCalls, DamagedCheckpoints) {
  Built c;
  open(c);
  c.build(2);
  const ringlet_pose head{{0.01, 0, 0}, {0, 0, 0, 0}};
  ASSERT_EQ(ringlet_step_to(c.hairs[0], &head), RINGLET_OK);
  const std::vector<std::byte> whole = checkpointOf(c.hairs[0]);
  const auto before = positionsOf(c.hairs[1], kParticles);
  std::mt19937 random(5);
  for (int k = 0; k < 300; ++k) {
    std::vector<std::byte> damaged = whole;
    for (int flips = 1 + k % 8; flips > 0; --flips)
      damaged[random() % damaged.size()] ^= static_cast<std::byte>(1u << random() % 8);
    if (damaged == whole) continue;  // a bit was flipped back
    EXPECT_EQ(ringlet_restore(c.hairs[1], damaged.data(), damaged.size()), RINGLET_ERROR) << k;
  }
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{7}, std::size_t{39}, std::size_t{40}, whole.size() - 1})
    EXPECT_EQ(ringlet_restore(c.hairs[1], whole.data(), size), RINGLET_ERROR) << size;
  EXPECT_EQ(positionsOf(c.hairs[1], kParticles), before) << "a checkpoint that is refused changes nothing";
  EXPECT_EQ(ringlet_restore(c.hairs[1], whole.data(), whole.size()), RINGLET_OK) << ringlet_error_message();
  EXPECT_EQ(positionsOf(c.hairs[1], kParticles), positionsOf(c.hairs[0], kParticles));
}

// Each differs in one thing from the hair that the checkpoint is of, and has as many bytes.
TEST_F(CWrongCalls, CheckpointsOfOtherHair) {
  Built c;
  open(c);
  c.build(1);
  const std::vector<std::byte> checkpoint = checkpointOf(c.hairs[0]);
  const std::pair<const char*, std::function<void(Built&)>> differences[] = {
      {"nothing", [](Built&) {}},
      {"gravity", [](Built& d) { ringlet_settings_set_vector(d.settings, "gravity", 0, -1, 0); }},
      {"fps", [](Built& d) { ringlet_settings_set(d.settings, "fps", 25); }},
      {"max_stretch", [](Built& d) { ringlet_settings_set(d.settings, "max_stretch", 1.2); }},
      {"air.wind", [](Built& d) { ringlet_settings_set_vector(d.settings, "air.wind", 1, 0, 0); }},
      {"contacts.friction", [](Built& d) { ringlet_settings_set(d.settings, "contacts.friction", 0.5); }},
      {"goal.strength", [](Built& d) { ringlet_settings_set(d.settings, "goal.strength", 2); }},
      {"bend_stiffness", [](Built& d) { ringlet_material_set(d.material, "bend_stiffness", 6); }},
      {"gravity_factor", [](Built& d) { ringlet_material_set(d.material, "gravity_factor", 0.5); }},
      {"variation.seed", [](Built& d) { ringlet_material_set(d.material, "variation.seed", 2); }},
      {"a point", [](Built& d) { d.groom.points[15].x += 0.1f; }},
      {"the unit", [](Built& d) { d.from.groom.metres_per_unit *= 1.5; }},
  };
  for (const auto& [name, change] : differences) {
    Built other;
    open(other);
    change(other);
    other.build(1);
    const ringlet_result result = ringlet_restore(other.hairs[0], checkpoint.data(), checkpoint.size());
    if (std::string(name) == "nothing") {
      EXPECT_EQ(result, RINGLET_OK) << ringlet_error_message();
    } else {
      EXPECT_EQ(result, RINGLET_ERROR) << name << " is taken";
      EXPECT_NE(std::string(ringlet_error_message()).find("of other hair"), std::string::npos)
          << name << ": " << ringlet_error_message();
    }
  }
  ringlet_body sphere = RINGLET_INIT(ringlet_body);
  sphere.shape = "sphere";
  ASSERT_EQ(ringlet_hair_set_bodies(c.hairs[0], &sphere, 1), RINGLET_OK);
  EXPECT_EQ(ringlet_restore(c.hairs[0], checkpoint.data(), checkpoint.size()), RINGLET_ERROR)
      << "other bodies";
  // Other cuts, none where there were some and some where there were none.
  Built uncut, cut;
  open(uncut), open(cut);
  uncut.build(1), cut.build(1);
  const ringlet_cut half{0, 5};
  ASSERT_EQ(ringlet_hair_cut(cut.hairs[0], &half, 1), RINGLET_OK) << ringlet_error_message();
  const std::vector<std::byte> ofCut = checkpointOf(cut.hairs[0]);
  for (const auto& [hair, bytes] : {std::pair{cut.hairs[0], &checkpoint}, {uncut.hairs[0], &ofCut}}) {
    EXPECT_EQ(ringlet_restore(hair, bytes->data(), bytes->size()), RINGLET_ERROR);
    EXPECT_NE(std::string(ringlet_error_message()).find("cut otherwise"), std::string::npos)
        << ringlet_error_message();
  }
  ASSERT_EQ(ringlet_hair_cut(uncut.hairs[0], &half, 1), RINGLET_OK) << ringlet_error_message();
  EXPECT_EQ(ringlet_restore(uncut.hairs[0], ofCut.data(), ofCut.size()), RINGLET_OK)
      << ringlet_error_message();
}

}  // namespace
}  // namespace ringlet::test::c_wrong_calls_test
