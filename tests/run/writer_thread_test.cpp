// WriterThread: order, room, and how failures come back; FrameSink over it.
#include "ringlet/run/writer_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "ringlet/run/frame_sink.h"

namespace ringlet::writer_thread_test {
namespace {

TEST(WriterThread, DoesJobsInOrderOnAnotherThread) {
  std::vector<int> done, expected(1000);
  std::iota(expected.begin(), expected.end(), 0);
  std::thread::id where;
  WriterThread writer(3);
  for (int job : expected) {
    ASSERT_TRUE(writer.hand([&done, &where, job]() -> Status {
      done.push_back(job);
      where = std::this_thread::get_id();
      return {};
    }));
  }
  ASSERT_TRUE(writer.finish());
  EXPECT_EQ(done, expected);
  EXPECT_NE(where, std::this_thread::get_id());
}

// The first job is held until no more fit: of five jobs one is being done, two wait, and the fourth waits for
// its place.
TEST(WriterThread, HandWaitsForRoom) {
  std::promise<void> gate;
  std::shared_future<void> open = gate.get_future().share();
  std::atomic<int> handed = 0, done = 0;
  WriterThread writer(2);
  std::thread handing([&] {
    for (int job = 0; job < 5; ++job) {
      EXPECT_TRUE(writer.hand([&]() -> Status {
        open.wait();
        ++done;
        return {};
      }));
      ++handed;
    }
  });
  while (handed < 3) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(handed, 3) << "more were taken than there is room for";
  EXPECT_EQ(done, 0);
  gate.set_value();
  handing.join();
  ASSERT_TRUE(writer.finish());
  EXPECT_EQ(done, 5);
}

TEST(WriterThread, AFailureComesBackAndEndsTheWork) {
  std::vector<int> done;
  WriterThread writer(1);
  std::string message;
  for (int job = 0; message.empty(); ++job) {
    ASSERT_LT(job, 100) << "the failure never came back";
    const Status handed = writer.hand([&done, job]() -> Status {
      if (job == 3) return Error{"the disk is full"};
      done.push_back(job);
      return {};
    });
    if (!handed) message = handed.error().message;
  }
  EXPECT_EQ(message, "the disk is full");
  const Status finished = writer.finish();
  ASSERT_FALSE(finished);
  EXPECT_EQ(finished.error().message, "the disk is full");
  EXPECT_EQ(done, (std::vector<int>{0, 1, 2})) << "nothing is done after it";
}

TEST(WriterThread, WhatAJobThrowsIsThrown) {
  WriterThread writer(1);
  ASSERT_TRUE(writer.hand([]() -> Status { throw std::runtime_error("thrown"); }));
  EXPECT_THROW((void)writer.finish(), std::runtime_error);
}

TEST(WriterThread, ItsEndDoesWhatWasHandedOver) {
  int done = 0;
  {
    WriterThread writer(8);
    for (int job = 0; job < 8; ++job) ASSERT_TRUE(writer.hand([&]() -> Status { return ++done, Status{}; }));
  }
  EXPECT_EQ(done, 8);
}

class Frames : public testing::Test {
 protected:
  Frames() {
    groom_.metresPerUnit = 0.5;
    groom_.addStrand(std::vector<Vec3f>{{0, 0, 0}, {0, 1, 0}});
  }
  ComputedFrame frame(int number) const {
    const float x = static_cast<float>(number);
    return {number, {{x, 0, 0}, {x, 1, 0}}, HeadPose{{1, 0, 0}, {}, 0}, {}};
  }
  Groom groom_;
};

TEST_F(Frames, ComeInOrderInTheFilesUnit) {
  std::vector<int> seen;
  std::vector<std::vector<Vec3f>> written;
  FrameSink sink(groom_, {.observe = [&](const ComputedFrame& f, std::span<const Vec3f>) -> Status {
                            seen.push_back(f.number);
                            return {};
                          },
                          .write = [&](int, std::vector<Vec3f> points, const ComputedFrame&) -> Status {
                            written.push_back(std::move(points));
                            return {};
                          }});
  for (int number = 1; number <= 50; ++number) ASSERT_TRUE(sink.hand(frame(number)));
  ASSERT_TRUE(sink.finish());
  EXPECT_EQ(sink.frameCount(), 50);
  ASSERT_EQ(written.size(), 50u);
  for (int number = 1; number <= 50; ++number) {
    EXPECT_EQ(seen[static_cast<std::size_t>(number) - 1], number);
    EXPECT_EQ(written[static_cast<std::size_t>(number) - 1][1], (Vec3f{2 * (1 + float(number)), 2, 0}));
  }
  EXPECT_EQ(sink.takeLastPositions(), frame(50).positions);
}

// What nobody needs is not converted; a frame with particles that have no position is counted all the same.
TEST_F(Frames, OnlyTheLastIsShownWhereNoOtherIsNeeded) {
  std::vector<int> observed;
  std::vector<std::vector<Vec3f>> written;
  FrameSink sink(groom_, {.observe = [&](const ComputedFrame& f, std::span<const Vec3f>) -> Status {
                            observed.push_back(f.number);
                            return {};
                          },
                          .write = [&](int, std::vector<Vec3f> points, const ComputedFrame&) -> Status {
                            written.push_back(std::move(points));
                            return {};
                          },
                          .needLastOnly = true});
  for (int number = 1; number <= 50; ++number) {
    ComputedFrame made = frame(number);
    if (number == 7) made.positions[1].y = std::numeric_limits<float>::infinity();
    ASSERT_TRUE(sink.hand(std::move(made)));
  }
  ASSERT_TRUE(sink.finish());
  ASSERT_TRUE(sink.finish());
  EXPECT_EQ(sink.frameCount(), 50);
  EXPECT_EQ(observed, (std::vector<int>{7, 50}));
  ASSERT_EQ(written.size(), 2u);
  EXPECT_EQ(written[1], (std::vector<Vec3f>{{102, 0, 0}, {102, 2, 0}}));
  EXPECT_EQ(sink.mostReplaced(), 1u);
  EXPECT_EQ(sink.takeLastPositions(), frame(50).positions);
}

TEST_F(Frames, AFailureOfTheLastComesBackWhereNoOtherIsNeeded) {
  FrameSink sink(
      groom_, {.observe = {},
               .write = [](int, std::vector<Vec3f>, const ComputedFrame&) -> Status { return Error{"full"}; },
               .needLastOnly = true});
  for (int number = 1; number <= 3; ++number) ASSERT_TRUE(sink.hand(frame(number)));
  const Status done = sink.finish();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "full");
}

TEST_F(Frames, ThoseAfterAFailureAreNotCounted) {
  FrameSink sink(groom_,
                 {.observe = {}, .write = [](int number, std::vector<Vec3f>, const ComputedFrame&) -> Status {
                    return number < 4 ? Status{} : Status{Error{"full"}};
                  }});
  bool failed = false;
  for (int number = 1; number <= 50 && !failed; ++number) failed = !sink.hand(frame(number));
  EXPECT_TRUE(failed);
  EXPECT_FALSE(sink.finish());
  EXPECT_EQ(sink.frameCount(), 3);
}

}  // namespace
}  // namespace ringlet::writer_thread_test
