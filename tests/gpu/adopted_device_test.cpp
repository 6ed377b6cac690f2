// Ringlet on a host's Vulkan device: its buffers in the host's kernels, its frames in the host's commands.
#include "tests/gpu/vulkan_host.h"

#include <cstring>
#include <deque>
#include <memory>
#include <vector>

#include "parity/sample_bodies.h"
#include "ringlet/c/ringlet.h"
#include "ringlet/follow/followers.h"
#include "ringlet/follow/level_of_detail.h"
#include "ringlet/gpu/device.h"
#include "ringlet/groom/generate.h"
#include "ringlet/solver/device_points.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/hair_frames.h"
#include "ringlet/solver/simulation.h"

namespace ringlet::test::adopted_device_test {
namespace {

HeadPose headAt(int which, double t) {
  return {Vec3d{which ? -0.3 : 0.5, 0.1, 0} * t, fromRotationVector(Vec3d{0, 4, 1} * t)};
}

Result<HairAsset> assetOn(const ComputeDevice& device, bool contacts = true, int strandCount = 40) {
  HeadParameters parameters;
  parameters.strandCount = strandCount;
  parameters.curl.particleCount = 24;
  Settings settings;
  settings.contacts.on = contacts;
  return HairAsset::build(device, *makeHead(parameters), {}, settings, {.heads = 2});
}

// As a host's kernel reads them.
void expectPositions(const std::vector<std::uint32_t>& found, const DevicePositions& chunk,
                     const std::vector<Vec3f>& wanted) {
  ASSERT_EQ(chunk.particles.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Vec3f& p = wanted[chunk.particles[i]];
    ASSERT_EQ(std::memcmp(&found[4 * i], &p, sizeof(p)), 0) << "particle " << i;
  }
}

// Two heads of one asset for 60 frames, on a device opened as Ringlet asks for and on one that has nothing
// switched on. After each frame the host's own kernel finds what a device of Ringlet's own comes to.
TEST(AdoptedDevice, AHostReadsPositionsWithItsOwnKernel) {
  constexpr int kFrames = 60;
  for (const bool asksForNeeds : {true, false}) {
    SCOPED_TRACE(asksForNeeds);
    auto host = std::make_unique<Host>(asksForNeeds);
    const auto messages = host->messages();
    {
      const auto device = ComputeDevice::adopt(host->handles());
      ASSERT_TRUE(device) << device.error().message;
      const auto asset = assetOn(*device);
      ASSERT_TRUE(asset) << asset.error().message;
      const auto own = ComputeDevice::open();
      ASSERT_TRUE(own) << own.error().message;
      const auto ownAsset = assetOn(*own);
      std::vector<Simulation> heads, expected;
      for (int which = 0; which < 2; ++which) {
        auto made = Simulation::create(*asset, {.head = headAt(which, 0), .readsBack = false});
        ASSERT_TRUE(made) << made.error().message;
        heads.push_back(std::move(*made));
        expected.push_back(*Simulation::create(*ownAsset, {.head = headAt(which, 0)}));
      }
      for (int frame = 1; frame <= kFrames; ++frame) {
        for (int which = 0; which < 2; ++which) {
          ASSERT_TRUE(heads[which].stepFrame(headAt(which, frame / 24.0)));
          ASSERT_TRUE(expected[which].stepFrame(headAt(which, frame / 24.0)));
        }
        for (int which = 0; which < 2; ++which) {
          const std::vector<Vec3f> wanted = *expected[which].positions();
          const std::vector<DevicePositions> chunks = heads[which].devicePositions();
          ASSERT_EQ(chunks.size(), 1u);
          const auto found = host->read(static_cast<VkBuffer>(chunks[0].buffer), chunks[0].bytes);
          expectPositions(found, chunks[0], wanted);
          if (frame == kFrames) {
            EXPECT_EQ(*heads[which].positions(), wanted) << "without being read back each frame";
            EXPECT_LT(Diagnostics(heads[which]).memory().frames,
                      Diagnostics(expected[which]).memory().frames);
          }
        }
      }
    }
    host.reset();  // everything of Ringlet's is gone, or the layer says so
    EXPECT_EQ(*messages, std::vector<std::string>{});
  }
}

std::vector<HeadPose> posesOf(int which, int frame) {
  const int steps = Settings{}.stepsPerFrame;
  std::vector<HeadPose> poses;
  for (int k = 1; k <= steps; ++k) poses.push_back(headAt(which, (frame - 1 + double(k) / steps) / 24.0));
  return poses;
}

// Two heads of one asset for 60 frames in commands of the host's, which read what they find there. With
// contacts one frame is under way at a time, without them two.
TEST(AdoptedDevice, AHostRecordsFramesIntoItsOwnCommands) {
  constexpr int kFrames = 60;
  for (const bool contacts : {false, true}) {
    SCOPED_TRACE(contacts);
    auto host = std::make_unique<Host>(true);
    const auto messages = host->messages();
    {
      const auto device = ComputeDevice::adopt(host->handles());
      ASSERT_TRUE(device) << device.error().message;
      const auto asset = assetOn(*device, contacts);
      ASSERT_TRUE(asset) << asset.error().message;
      const auto ownAsset = assetOn(*ComputeDevice::open(), contacts);
      std::vector<Simulation> heads, expected;
      for (int which = 0; which < 2; ++which) {
        heads.push_back(*Simulation::create(*asset, {.head = headAt(which, 0), .readsBack = which == 0}));
        expected.push_back(*Simulation::create(*ownAsset, {.head = headAt(which, 0)}));
      }
      std::deque<Host::Work> underWay;
      std::deque<std::vector<Vec3f>> wanted;
      for (int frame = 1; frame <= kFrames; ++frame) {
        SCOPED_TRACE(frame);
        const std::vector<HeadPose> poses[2] = {posesOf(0, frame), posesOf(1, frame)};
        for (int which = 0; which < 2; ++which) ASSERT_TRUE(expected[which].stepFrame(poses[which]));
        wanted.push_back(*expected[0].positions());
        const auto record = [&](VkCommandBuffer commands) {
          const Status status =
              recordFrames(std::vector<HairFrame>{{&heads[0], poses[0]}, {&heads[1], poses[1]}}, commands);
          EXPECT_TRUE(status) << status.error().message;
        };
        underWay.push_back(host->submit(record));
        EXPECT_FALSE(heads[0].positions()) << "nobody has said that the frame is over";
        for (; underWay.size() > (contacts || frame == kFrames ? 0 : 1); underWay.pop_front()) {
          host->wait(underWay.front());
          for (Simulation& head : heads) {
            const Status over = frameIsOver(head);
            ASSERT_TRUE(over) << over.error().message;
          }
          EXPECT_EQ(heads[0].framePositions(), wanted.front());
          wanted.pop_front();
        }
        if (!contacts && frame % 20 != 0) continue;
        for (; !underWay.empty(); underWay.pop_front()) {
          host->wait(underWay.front());
          for (Simulation& head : heads) ASSERT_TRUE(frameIsOver(head));
          wanted.pop_front();
        }
        const DevicePositions chunk = heads[1].devicePositions()[0];
        expectPositions(host->read(static_cast<VkBuffer>(chunk.buffer), chunk.bytes), chunk,
                        *expected[1].positions());
      }
      for (int which = 0; which < 2; ++which) {
        EXPECT_EQ(heads[which].state()->positions, expected[which].state()->positions);
        EXPECT_EQ(heads[which].state()->velocities, expected[which].state()->velocities);
      }
    }
    host.reset();
    EXPECT_EQ(*messages, std::vector<std::string>{});
  }
}

// In the submission that steps the hair.
TEST(AdoptedDevice, AHostReadsAFrameInTheSameCommands) {
  Host host(true);
  {
    const auto device = ComputeDevice::adopt(host.handles());
    auto hair = Simulation::create(*assetOn(*device, false), {.head = headAt(0, 0), .readsBack = false});
    auto expected = Simulation::create(*assetOn(*ComputeDevice::open(), false), {.head = headAt(0, 0)});
    const DevicePositions chunk = hair->devicePositions()[0];
    for (int frame = 1; frame <= 5; ++frame) {
      const std::vector<HeadPose> poses = posesOf(0, frame);
      const auto found = host.read(static_cast<VkBuffer>(chunk.buffer), chunk.bytes, [&](auto commands) {
        ASSERT_TRUE(recordFrames(std::vector<HairFrame>{{&*hair, poses}}, commands));
      });
      ASSERT_TRUE(frameIsOver(*hair));
      ASSERT_TRUE(expected->stepFrame(poses));
      expectPositions(found, chunk, *expected->positions());
    }
  }
  EXPECT_EQ(*host.messages(), std::vector<std::string>{});
}

// Hairs that follow are moved and read in the submission that steps their strands.
TEST(AdoptedDevice, AHostRecordsHairsThatFollow) {
  Host host(true);
  {
    const auto device = ComputeDevice::adopt(host.handles()), own = ComputeDevice::open();
    const Groom groom = *makeHead({.curl = {.turns = 4, .particleCount = 32}, .strandCount = 60});
    const auto level = levelOfDetail(groom, 0.3);
    ASSERT_TRUE(level);
    const std::vector<Body> bodies{{.name = "ball", .radius = 0.07}};
    auto hair =
        *Simulation::create(*device, level->groom, {}, {}, {.head = headAt(0, 0), .readsBack = false});
    auto expected = *Simulation::create(*own, level->groom, {}, {}, {.head = headAt(0, 0)});
    auto followers = Followers::create(*device, hair, level->groom, level->hairs, bodies, level->own);
    auto wanted = Followers::create(*own, expected, level->groom, level->hairs, bodies, level->own);
    ASSERT_TRUE(followers) << followers.error().message;
    const FollowedPoints points = followers->points();
    for (int frame = 1; frame <= 5; ++frame) {
      const std::vector<HeadPose> poses = posesOf(0, frame);
      const std::vector<BodyPose> places{{poses.back().position + Vec3d{0, 0, 0.08}, {}}};
      const auto found = host.read(static_cast<VkBuffer>(points.buffer), points.bytes, [&](auto commands) {
        ASSERT_TRUE(recordFrames(std::vector<HairFrame>{{&hair, poses}}, commands));
        followers->record(commands, poses.back(), places);
      });
      ASSERT_TRUE(frameIsOver(hair));
      ASSERT_TRUE(expected.stepFrame(poses));
      ASSERT_TRUE(wanted->follow(places));
      const std::vector<Vec3f> right = *wanted->positions();
      ASSERT_EQ(right.size(), 60u * 32u);
      for (std::size_t i = 0; i < right.size(); ++i)
        ASSERT_EQ(std::memcmp(&found[4 * i], &right[i], sizeof(right[i])), 0) << "point " << i;
    }
  }
  EXPECT_EQ(*host.messages(), std::vector<std::string>{});
}

// What cannot be recorded changes nothing: the frames that can go on as if it had not been asked for.
TEST(AdoptedDevice, AHostIsToldWhatItCannotRecord) {
  for (const bool contacts : {false, true}) {
    SCOPED_TRACE(contacts);
    Host host(true);
    {
      const auto device = ComputeDevice::adopt(host.handles());
      auto hair = *Simulation::create(*assetOn(*device, contacts), {.head = headAt(0, 0)});
      auto expected = *Simulation::create(*assetOn(*ComputeDevice::open(), contacts), {.head = headAt(0, 0)});
      const std::vector<HeadPose> jump(posesOf(0, 1).size(), HeadPose{Vec3d{50, 0, 0}, {}});
      std::vector<Host::Work> works;
      const auto step = [&](const std::vector<HeadPose>& poses) {
        Status status;
        works.push_back(host.submit([&](VkCommandBuffer commands) {
          status = recordFrames(std::vector<HairFrame>{{&hair, poses}}, commands);
        }));
        return status;
      };
      EXPECT_TRUE(frameIsOver(hair)) << "there is none";
      const int most = contacts ? 1 : 2;
      for (int frame = 1; frame <= most; ++frame) {
        ASSERT_TRUE(step(posesOf(0, frame)));
        ASSERT_TRUE(expected.stepFrame(posesOf(0, frame)));
      }
      const Status tooMany = step(posesOf(0, most + 1)), whileJumping = step(jump);
      EXPECT_FALSE(tooMany);
      EXPECT_FALSE(whileJumping);
      EXPECT_NE(tooMany.error().message.find("say that the frame is over"), std::string::npos);
      EXPECT_NE(whileJumping.error().message.find("say that the frame is over"), std::string::npos);
      const auto early = hair.positions();
      ASSERT_FALSE(early);
      EXPECT_NE(early.error().message.find("say that the frame is over"), std::string::npos);
      for (const Host::Work& work : works) host.wait(work);
      works.clear();
      for (int frame = 1; frame <= most; ++frame) ASSERT_TRUE(frameIsOver(hair));
      EXPECT_EQ(*hair.positions(), *expected.positions());
      ASSERT_TRUE(step(jump));
      ASSERT_TRUE(expected.stepFrame(jump));
      ASSERT_TRUE(frameIsOver(hair)) << "a jump is none of the device's";
      EXPECT_EQ(*hair.positions(), *expected.positions());
      for (const Host::Work& work : works) host.wait(work);
    }
    EXPECT_EQ(*host.messages(), std::vector<std::string>{});
  }
}

// Buffers lie in pieces of the host's memory; each comes back, and the bits are those of memory by the
// driver.
TEST(AdoptedDevice, AHostGivesTheMemory) {
  constexpr std::uint64_t kBlock = 16ull << 20;
  auto host = std::make_unique<Host>(true);
  const auto messages = host->messages();
  HostPool pool(*host, kBlock);
  {
    HostVulkan handles = host->handles();
    pool.serve(handles);
    const auto device = ComputeDevice::adopt(handles), own = ComputeDevice::open();
    ASSERT_TRUE(device) << device.error().message;
    for (const bool contacts : {false, true}) {
      Simulation hair = *Simulation::create(*assetOn(*device, contacts)),
                 expected = *Simulation::create(*assetOn(*own, contacts));
      for (int frame = 1; frame <= 8; ++frame) {
        ASSERT_TRUE(hair.stepFrame(headAt(0, frame / 24.0)));
        ASSERT_TRUE(expected.stepFrame(headAt(0, frame / 24.0)));
      }
      EXPECT_TRUE(hair.state()->positions == expected.state()->positions);
      EXPECT_TRUE(hair.state()->velocities == expected.state()->velocities);
    }
    EXPECT_GT(pool.given(), 40u);
    const auto tooMuch = assetOn(*device, false, 80'000);
    ASSERT_FALSE(tooMuch);
    EXPECT_EQ(tooMuch.error().fault, Fault::deviceMemory) << tooMuch.error().message;
  }
  EXPECT_EQ(pool.kept(), 0u);
  EXPECT_EQ(*messages, std::vector<std::string>{});
}

ringlet_host_vulkan hostInC(const HostVulkan& handles) {
  ringlet_host_vulkan c = RINGLET_INIT(ringlet_host_vulkan);
  c.get_instance_proc_addr = handles.getInstanceProcAddr, c.instance = handles.instance;
  c.physical_device = handles.physicalDevice, c.device = handles.device, c.queue = handles.queue;
  c.queue_family = handles.queueFamily, c.api_version = handles.apiVersion;
  return c;
}

// The same through the C interface.
TEST(AdoptedDevice, AHostInCGivesTheMemory) {
  Host host(true);
  HostPool pool(host, 16ull << 20);
  HostVulkan handles = host.handles();
  pool.serve(handles);
  ringlet_host_vulkan c = hostInC(handles);
  c.user = &handles;
  c.allocate = [](void* user, uint64_t bytes, uint64_t alignment, uint32_t type, ringlet_memory* memory) {
    HostMemory given;
    const int result = static_cast<HostVulkan*>(user)->allocate(bytes, alignment, type, given);
    *memory = {given.memory, given.offset, given.mapped, given.own};
    return result;
  };
  c.free = [](void* user, const ringlet_memory* memory) {
    static_cast<HostVulkan*>(user)->free({memory->memory, memory->offset, memory->mapped, memory->own});
  };
  // As many names as there is room for.
  ringlet_host_needs needs = RINGLET_INIT(ringlet_host_needs);
  ASSERT_EQ(ringlet_device_needs(&c, &needs, nullptr, 0), RINGLET_OK) << ringlet_error_message();
  const std::vector<std::string> expected = ComputeDevice::needs(handles)->extensions;
  ASSERT_EQ(needs.extension_count, expected.size());
  for (uint32_t room = 0; room <= needs.extension_count + 1; ++room) {
    std::vector<const char*> names(expected.size() + 2, "untouched");
    ASSERT_EQ(ringlet_device_needs(&c, &needs, names.data(), room), RINGLET_OK);
    for (std::size_t k = 0; k < names.size(); ++k)
      EXPECT_STREQ(names[k], k < room && k < expected.size() ? expected[k].c_str() : "untouched") << room;
  }
  ringlet_device* device = nullptr;
  ASSERT_EQ(ringlet_device_adopt(&c, &device), RINGLET_OK) << ringlet_error_message();
  const float points[] = {0, 0, 0, 0, -0.01f, 0, 0, -0.02f, 0, 0, -0.03f, 0};
  const uint32_t size = 4;
  ringlet_groom groom = RINGLET_INIT(ringlet_groom);
  groom.points = points, groom.strand_sizes = &size, groom.strand_count = 1;
  ringlet_asset* asset = nullptr;
  ASSERT_EQ(ringlet_asset_build(device, &groom, nullptr, nullptr, nullptr, &asset), RINGLET_OK)
      << ringlet_error_message();
  EXPECT_GT(pool.kept(), 0u);
  ringlet_asset_release(asset);
  ringlet_device_release(device);
  EXPECT_GT(pool.given(), 0u);
  EXPECT_EQ(pool.kept(), 0u);
  EXPECT_EQ(*host.messages(), std::vector<std::string>{});
}

// Of each point of a mesh x, y and z, and what else stands between them.
std::vector<float> numbersOf(const std::vector<Vec3d>& points, std::size_t before, std::size_t each) {
  std::vector<float> numbers(before + each * points.size(), -7);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3f p(points[i]);
    std::copy_n(&p.x, 3, &numbers[before + each * i]);
  }
  return numbers;
}

// A body that bends as commands of the host's write it, which are submitted and not waited for: the bits are
// those of the same points from the host's memory.
TEST(AdoptedDevice, AHostsBuffersBendABody) {
  Host host(true);
  {
    const auto device = ComputeDevice::adopt(host.handles());
    ASSERT_TRUE(device) << device.error().message;
    const Body bodies[] = {parity::bendingBall(0.06, 0.006), parity::sheet(0.3, {0, -0.1, 0})};
    const auto asset = assetOn(*device, false);
    ASSERT_TRUE(asset) << asset.error().message;
    const InitialState start{.head = headAt(0, 0), .bodies = bodies};
    auto hair = Simulation::create(*asset, start), expected = Simulation::create(*asset, start),
         still = Simulation::create(*asset, start);
    ASSERT_TRUE(hair && expected && still);
    for (int frame = 1; frame <= 4; ++frame) {
      std::vector<Host::Written> written;
      std::vector<DevicePoints> buffers;
      std::vector<std::vector<Vec3d>> points;
      for (const Body& body : bodies) {
        const std::size_t before = points.empty() ? 0 : 8, each = points.empty() ? 3 : 4;
        std::vector<Vec3d> bent = parity::bentPoints(*body.mesh, frame / 24.0);
        for (Vec3d& p : bent) p = Vec3d(Vec3f(p));
        written.push_back(host.write(numbersOf(bent, before, each)));
        buffers.push_back({.buffer = written.back().owned.buffer,
                           .offset = 4 * before,
                           .stride = static_cast<std::uint32_t>(4 * each),
                           .count = static_cast<std::uint32_t>(bent.size())});
        points.push_back(std::move(bent));
      }
      const auto read = readPoints(*device, buffers);
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_EQ(*read, points) << frame;
      const std::vector<std::span<const Vec3d>> found(read->begin(), read->end()),
          given(points.begin(), points.end());
      const std::vector<HeadPose> poses = posesOf(0, frame);
      ASSERT_TRUE(hair->stepFrame(poses, {}, {}, found));
      ASSERT_TRUE(expected->stepFrame(poses, {}, {}, given));
      ASSERT_TRUE(still->stepFrame(poses));
      for (const Host::Written& one : written) host.drop(one);
    }
    EXPECT_EQ(*hair->positions(), *expected->positions());
    EXPECT_NE(*hair->positions(), *still->positions()) << "the bodies must move hair";
    for (const DevicePoints& wrong : {DevicePoints{},
                                      {.buffer = &host, .offset = 2},
                                      {.buffer = &host, .stride = 8},
                                      {.buffer = &host, .stride = 14},
                                      {.buffer = &host, .stride = 2048}})
      EXPECT_FALSE(readPoints(*device, std::span(&wrong, 1)));
  }
  EXPECT_EQ(*host.messages(), std::vector<std::string>{});
}

// The same through the C interface.
TEST(AdoptedDevice, AHostInCReadsPointsOfItsBuffers) {
  Host host(true);
  const HostVulkan handles = host.handles();
  ringlet_host_vulkan c = hostInC(handles);
  ringlet_device* device = nullptr;
  ASSERT_EQ(ringlet_device_adopt(&c, &device), RINGLET_OK) << ringlet_error_message();
  const std::vector<Vec3d> points{{1, 2, 3}, {-4, 5.5, 6}, {7, 8, -0.25}};
  const Host::Written written = host.write(numbersOf(points, 1, 5));
  ringlet_device_points buffer = RINGLET_INIT(ringlet_device_points);
  buffer.buffer = written.owned.buffer, buffer.offset = 4, buffer.stride = 20, buffer.count = 3;
  double xyz[9] = {};
  double* places[] = {xyz};
  EXPECT_EQ(ringlet_read_device_points(device, &buffer, 1, places), RINGLET_OK) << ringlet_error_message();
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ((Vec3d{xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}), points[i]);
  places[0] = nullptr;
  EXPECT_EQ(ringlet_read_device_points(device, &buffer, 1, places), RINGLET_ERROR_INVALID_ARGUMENT);
  places[0] = xyz, buffer.stride = 8;
  EXPECT_EQ(ringlet_read_device_points(device, &buffer, 1, places), RINGLET_ERROR);
  host.drop(written);
  ringlet_device_release(device);
  EXPECT_EQ(*host.messages(), std::vector<std::string>{});
}

// Pictures are drawn by them, where they are there.
TEST(AdoptedDevice, Uses64BitAtomicsThatTheHostSwitchedOn) {
  const auto own = ComputeDevice::open();
  ASSERT_TRUE(own) << own.error().message;
  for (const bool asksForNeeds : {true, false}) {
    auto host = std::make_unique<Host>(asksForNeeds);
    const auto messages = host->messages();
    {
      const auto device = ComputeDevice::adopt(host->handles());
      ASSERT_TRUE(device) << device.error().message;
      EXPECT_EQ(device->gpu().properties().hasAtomicInt64,
                asksForNeeds && own->gpu().properties().hasAtomicInt64);
    }
    host.reset();
    EXPECT_TRUE(messages->empty()) << messages->front();
  }
}

TEST(AdoptedDevice, RefusesAnAllocatorThatIsHalfOne) {
  Host host(true);
  HostVulkan handles = host.handles();
  handles.free = [](const HostMemory&) {};
  auto refused = ComputeDevice::adopt(handles);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "a host's allocator either allocates and frees, or does neither");
  HostPool pool(host, 1 << 20);
  pool.serve(handles);
  const auto allocate = handles.allocate;
  handles.allocate = [&](auto bytes, auto alignment, auto type, HostMemory& piece) {
    const int result = allocate(bytes, alignment, type, piece);
    piece.mapped = nullptr;
    return result;
  };
  const auto asset = assetOn(*ComputeDevice::adopt(handles));
  ASSERT_FALSE(asset);
  EXPECT_NE(asset.error().message.find("the host's allocator gave memory of a type that can be mapped"),
            std::string::npos)
      << asset.error().message;
}

TEST(AdoptedDevice, SaysWhatAHostLacks) {
  Host host(true);
  HostVulkan handles = host.handles();
  handles.queueFamily = 99;
  auto refused = ComputeDevice::adopt(handles);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("of family 99, which does not compute"), std::string::npos)
      << refused.error().message;
  handles = host.handles();
  handles.device = nullptr;
  refused = ComputeDevice::adopt(handles);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "a host hands over no physical device, no device or no queue");
  handles.instance = nullptr;
  EXPECT_FALSE(ComputeDevice::adopt(handles));
  EXPECT_FALSE(ComputeDevice::needs(handles));
  handles = host.handles();
  handles.apiVersion = VK_API_VERSION_1_0;
  const auto needs = ComputeDevice::needs(handles);
  ASSERT_FALSE(needs);
  EXPECT_NE(needs.error().message.find("the instance was made for Vulkan 1.0.0, needed is 1.1"),
            std::string::npos)
      << needs.error().message;
}

}  // namespace
}  // namespace ringlet::test::adopted_device_test
