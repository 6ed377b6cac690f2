// Implements remote_hair.h. A call is its number and what it takes, as an Archive has them; its answer is
// what went wrong, or nothing, and what it gives.
#include "mpi/remote_hair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpi/ranks.h"
#include "ringlet/base/archive.h"

namespace ringlet::mpi {
namespace {

enum class Call : std::uint32_t {
  leave = kLeave,  // is not answered
  submit,
  wait,
  positions,
  checkpoint,
  restore,
  reports,
  times,
  facts
};

// Which frame, and of a step which.
struct FrameNumber {
  std::int32_t frame = 0, step = -1;  // -1: the whole frame
};

void archiveTexts(Archive& archive, std::vector<std::string>& texts) {
  std::uint64_t count = texts.size();
  archive.value(count);
  texts.resize(count);
  for (std::string& text : texts) archive.text(text);
}

void archiveTimes(Archive& archive, HairTimes& times) {
  std::vector<std::string> names;
  std::vector<double> values;
  for (const auto& [stage, time] : times.stages) names.push_back(stage), values.push_back(time);
  archiveTexts(archive, names);
  archive.list(values);
  for (std::size_t k = 0; k < names.size(); ++k) times.stages[names[k]] = values[k];
}

void archiveFacts(Archive& archive, HairFacts& facts) {
  for (std::string* text : {&facts.device, &facts.driver, &facts.kernel}) archive.text(*text);
  archive.value(facts.rigidStrandCount);
  archive.value(facts.isTuned);
  archive.value(facts.compileMilliseconds);
  std::uint64_t bytes = facts.deviceBytes.value_or(0);
  archive.value(bytes);
  facts.deviceBytes = bytes;
  archiveTexts(archive, facts.warnings);
  archiveTexts(archive, facts.messages);
}

class RemoteHair : public SceneHair {
 public:
  RemoteHair(int rank, std::size_t pointCount, std::vector<std::uint32_t> points)
      : rank_(rank), pointCount_(pointCount), points_(std::move(points)) {}
  ~RemoteHair() override {
    (void)settle();
    std::uint32_t leave = kLeave;
    sendTo(rank_, std::as_bytes(std::span(&leave, 1)));
  }

  Status submit(const SceneFrame& frame) override {
    if (Status before = settle(); !before) return before;
    Archive call = begin(Call::submit);
    FrameNumber number{frame.number, frame.ofStep ? static_cast<std::int32_t>(*frame.ofStep) : -1};
    call.value(number);
    sendTo(rank_, call.take());
    isUnderWay_ = true;
    return {};
  }
  // The answer has the positions too.
  Status wait() override {
    std::vector<std::byte> bytes;
    if (Status waited = ask(begin(Call::wait), &bytes); !waited) return waited;
    givenIn(bytes).list(own_);
    return {};
  }
  void framePositions(std::span<Vec3f> all) override {
    for (std::size_t k = 0; k < own_.size(); ++k) all[points_[k]] = own_[k];
  }
  Result<std::vector<Vec3f>> positions() override {
    const auto own = askFor<Vec3f>(begin(Call::positions));
    if (!own) return own.error();
    std::vector<Vec3f> all(pointCount_);
    for (std::size_t k = 0; k < points_.size(); ++k) all[points_[k]] = (*own)[k];
    return all;
  }
  Result<std::vector<std::byte>> checkpoint() override { return askFor<std::byte>(begin(Call::checkpoint)); }
  Status restore(const SceneFrames&, int frame, std::span<const std::byte> checkpoint) override {
    Archive call = begin(Call::restore);
    std::vector bytes(checkpoint.begin(), checkpoint.end());
    call.value(frame), call.list(bytes);
    return ask(std::move(call));
  }
  Result<HairReports> reports() override {
    std::vector<std::byte> bytes;
    if (Status asked = ask(begin(Call::reports), &bytes); !asked) return asked.error();
    Archive archive = givenIn(bytes);
    HairReports both;
    archive.value(both.hair), archive.value(both.contacts);
    return both;
  }
  HairTimes times() const override { return told<HairTimes>(Call::times, archiveTimes); }
  bool tellsTimesOfFrames() const override { return false; }
  HairFacts facts() const override { return told<HairFacts>(Call::facts, archiveFacts); }

  /// Its next answer.
  Status answer(std::vector<std::byte>& bytes) const {
    bytes = receiveFrom(rank_);
    Archive archive = Archive::reading(bytes);
    std::string why;
    archive.text(why);
    return why.empty() ? Status{} : Status{Error{why}};
  }

 private:
  static Archive begin(Call call) {
    Archive archive = Archive::writing();
    archive.value(call);
    return archive;
  }
  // After the empty text of an answer that is fine.
  static Archive givenIn(std::span<const std::byte> answer) {
    return Archive::reading(answer.subspan(sizeof(std::uint64_t)));
  }
  // The frame under way is over; how it ended.
  Status settle() const {
    std::vector<std::byte> nothing;
    if (std::exchange(isUnderWay_, false)) lost_ = answer(nothing);
    return lost_;
  }
  Status ask(Archive call, std::vector<std::byte>* given = nullptr) const {
    if (Status before = settle(); !before) return before;
    sendTo(rank_, call.take());
    std::vector<std::byte> bytes;
    Status done = answer(bytes);
    if (given) *given = std::move(bytes);
    return done;
  }
  template <class T>
  Result<std::vector<T>> askFor(Archive call) const {
    std::vector<std::byte> bytes;
    if (Status asked = ask(std::move(call), &bytes); !asked) return asked.error();
    Archive archive = givenIn(bytes);
    std::vector<T> values;
    archive.list(values);
    return values;
  }
  // Empty where the rank cannot tell.
  template <class T>
  T told(Call call, void (*archiveIt)(Archive&, T&)) const {
    T value;
    std::vector<std::byte> bytes;
    if (!ask(begin(call), &bytes)) return value;
    Archive archive = givenIn(bytes);
    archiveIt(archive, value);
    return value;
  }

  int rank_;
  std::size_t pointCount_;             // of the groom
  std::vector<std::uint32_t> points_;  // of the part, in the groom
  std::vector<Vec3f> own_;             // their positions after the frame waited for
  mutable Status lost_{};
  mutable bool isUnderWay_ = false;  // a frame whose answer is still to come
};

// The other side of a call: what it gives goes into `given`.
class Server {
 public:
  Server(SceneHair& hair, const SceneFrames& frames, std::size_t pointCount,
         std::vector<std::uint32_t> points)
      : hair_(hair), frames_(frames), points_(std::move(points)), whole_(pointCount), own_(points_.size()) {}

  Status answer(Archive& call, Archive& given) {
    Call which{};
    call.value(which);
    switch (which) {
      case Call::submit:
        return submit(call);
      case Call::wait: {
        if (Status waited = hair_.wait(); !waited) return waited;
        hair_.framePositions(whole_);
        giveOwn(whole_, given);
        return {};
      }
      case Call::positions: {
        const auto all = hair_.positions();
        if (!all) return all.error();
        giveOwn(*all, given);
        return {};
      }
      case Call::checkpoint: {
        auto state = hair_.checkpoint();
        if (!state) return state.error();
        given.list(*state);
        return {};
      }
      case Call::restore: {
        int frame = 0;
        std::vector<std::byte> bytes;
        call.value(frame), call.list(bytes);
        return hair_.restore(frames_, frame, bytes);
      }
      case Call::reports: {
        auto both = hair_.reports();
        if (!both) return both.error();
        given.value(both->hair), given.value(both->contacts);
        return {};
      }
      case Call::times: {
        HairTimes times = hair_.times();
        archiveTimes(given, times);
        return {};
      }
      case Call::facts: {
        HairFacts facts = hair_.facts();
        archiveFacts(given, facts);
        return {};
      }
      case Call::leave:
        break;
    }
    return Error{"rank 0 is another ringlet"};
  }

 private:
  Status submit(Archive& call) {
    FrameNumber number;
    call.value(number);
    if (!frame_ || frame_->number != number.frame) {
      auto frame = frames_.at(number.frame);
      if (!frame) return frame.error();
      frame_ = std::move(*frame);
    }
    return hair_.submit(number.step < 0 ? *frame_ : frame_->step(static_cast<std::size_t>(number.step)));
  }
  void giveOwn(std::span<const Vec3f> all, Archive& given) {
    for (std::size_t k = 0; k < own_.size(); ++k) own_[k] = all[points_[k]];
    given.list(own_);
  }

  SceneHair& hair_;
  const SceneFrames& frames_;
  std::optional<SceneFrame> frame_;    // whose steps come one after the other
  std::vector<std::uint32_t> points_;  // of the part, in the groom
  std::vector<Vec3f> whole_, own_;     // positions of the groom, of which some are known, and of the part
};

// What is given comes after this.
Archive beginAnswer(std::string why = "") {
  Archive answer = Archive::writing();
  answer.text(why);
  return answer;
}

// Of these strands, in the groom.
std::vector<std::uint32_t> pointsOf(const Groom& groom, std::span<const std::uint32_t> strands) {
  std::vector<std::uint32_t> points;
  for (const std::uint32_t s : strands)
    for (std::uint32_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i) points.push_back(i);
  return points;
}

}  // namespace

Result<std::unique_ptr<SceneHair>> makeRemoteHair(int rank, const Groom& groom,
                                                  std::span<const std::uint32_t> strands) {
  auto made = std::make_unique<RemoteHair>(rank, groom.points.size(), pointsOf(groom, strands));
  std::vector<std::byte> nothing;
  if (Status ready = made->answer(nothing); !ready)
    return Error{fmt::format("rank {}: {}", rank, ready.error().message)};
  return std::unique_ptr<SceneHair>(std::move(made));
}

void serve(Result<std::unique_ptr<SceneHair>> hair, const SceneFrames& frames, const Groom& groom,
           std::span<const std::uint32_t> strands) {
  if (isToldToLeave()) return;
  sendTo(0, beginAnswer(hair ? "" : hair.error().message).take());
  try {
    std::optional<Server> server;
    if (hair) server.emplace(**hair, frames, groom.points.size(), pointsOf(groom, strands));
    for (;;) {
      const std::vector<std::byte> bytes = receiveFrom(0);
      if (saysLeave(bytes) || !server) return;
      Archive call = Archive::reading(bytes), answer = beginAnswer();
      const Status done = server->answer(call, answer);
      sendTo(0, done ? answer.take() : beginAnswer(done.error().message).take());
    }
  } catch (const std::exception& failure) {
    endRanks(failure.what());
  }
}

}  // namespace ringlet::mpi
