// Implements remote_backend.h. A call is its number and what it takes, as an Archive has them; its answer is
// what went wrong, or nothing, and what it gives.
#include "program/remote_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "program/ranks.h"
#include "ringlet/base/archive.h"

namespace ringlet::program {
namespace {

enum class Call : std::uint32_t {
  leave = kLeave,  // is not answered
  submitFrame,
  waitFrame,
  change,
  setFields,
  setGoals,
  positions,
  checkpoint,
  restore,
  reports,
  facts
};

template <class T>
std::vector<T> copyOf(std::span<const T> values) {
  return {values.begin(), values.end()};
}

// Grids stay: both ranks have read them.
void archiveField(Archive& archive, ForceField& field) {
  archive.text(field.name);
  archive.value(field.place);
  archive.value(field.axis);
  archive.value(field.aboutAxis);
  for (double ForceField::*number :
       {&ForceField::axial, &ForceField::radial, &ForceField::around, &ForceField::core, &ForceField::reach,
        &ForceField::drag, &ForceField::front, &ForceField::thickness, &ForceField::gridShare})
    archive.value(field.*number);
}
void archiveFields(Archive& archive, std::vector<ForceField>& fields, std::span<const ForceField> known) {
  std::uint64_t count = fields.size();
  archive.value(count);
  if (archive.isReading()) fields.resize(count);
  for (std::size_t k = 0; k < fields.size(); ++k) {
    archiveField(archive, fields[k]);
    if (archive.isReading() && k < known.size()) fields[k].grid = known[k].grid;
  }
}

void archiveTexts(Archive& archive, std::vector<std::string>& texts) {
  std::uint64_t count = texts.size();
  archive.value(count);
  texts.resize(count);
  for (std::string& text : texts) archive.text(text);
}

// What a backend says of itself.
struct Facts {
  std::map<std::string, double> stages{};
  std::uint64_t rigidStrandCount = 0, deviceBytes = 0;
  std::vector<std::string> warnings{}, messages{};
  std::string device{}, driver{}, kernel{};
  bool isTuned = false;
  double compileMilliseconds = 0;

  static Facts of(const Backend& hair) {
    return {hair.stageMilliseconds(),
            hair.rigidStrandCount(),
            hair.deviceBytes().value_or(0),
            hair.warnings(),
            hair.deviceMessages(),
            hair.device(),
            hair.driver(),
            hair.kernel(),
            hair.isTuned(),
            hair.compileMilliseconds()};
  }
  void archive(Archive& archive) {
    std::vector<std::string> names;
    std::vector<double> times;
    for (const auto& [stage, time] : stages) names.push_back(stage), times.push_back(time);
    archiveTexts(archive, names);
    archive.list(times);
    for (std::size_t k = 0; k < names.size(); ++k) stages[names[k]] = times[k];
    archive.value(rigidStrandCount);
    archive.value(deviceBytes);
    archiveTexts(archive, warnings);
    archiveTexts(archive, messages);
    for (std::string* text : {&device, &driver, &kernel}) archive.text(*text);
    archive.value(isTuned);
    archive.value(compileMilliseconds);
  }
};

class RemoteBackend : public Backend {
 public:
  RemoteBackend(int rank, std::size_t pointCount, std::vector<std::uint32_t> points)
      : rank_(rank), pointCount_(pointCount), points_(std::move(points)) {}
  ~RemoteBackend() override {
    (void)settle();
    std::uint32_t leave = kLeave;
    sendTo(rank_, std::as_bytes(std::span(&leave, 1)));
  }

  Status submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                     std::span<const BodyPose> rootPoses) override {
    if (Status before = settle(); !before) return before;
    Archive call = begin(Call::submitFrame);
    auto heads = copyOf(stepPoses);
    auto bodies = copyOf(bodyPoses), roots = copyOf(rootPoses);
    call.list(heads), call.list(bodies), call.list(roots);
    sendTo(rank_, call.take());
    isUnderWay_ = true;
    return {};
  }
  // The answer has the positions too.
  Status waitFrame() override {
    std::vector<std::byte> bytes;
    if (Status waited = ask(begin(Call::waitFrame), &bytes); !waited) return waited;
    givenIn(bytes).list(own_);
    return {};
  }
  Status change(const Settings&, const Material&, double keysAt) override {
    Archive call = begin(Call::change);
    call.value(keysAt);
    return ask(std::move(call));
  }
  Status setFields(std::span<const ForceField> fields, std::span<const ForceField> from) override {
    Archive call = begin(Call::setFields);
    auto now = copyOf(fields), before = copyOf(from);
    archiveFields(call, now, {}), archiveFields(call, before, {});
    return ask(std::move(call));
  }
  Status setGoals(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
                  std::span<const Vec3f> from) override {
    Archive call = begin(Call::setGoals);
    auto now = copyOf(places), before = copyOf(from);
    auto pulls = copyOf(strengths);
    call.list(now), call.list(pulls), call.value(dampingRatio), call.list(before);
    return ask(std::move(call));
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
  Status restore(std::span<const std::byte> checkpoint) override {
    Archive call = begin(Call::restore);
    auto bytes = copyOf(checkpoint);
    call.list(bytes);
    return ask(std::move(call));
  }
  Result<SimulationReport> report() override {
    const auto both = reports();
    return both ? Result<SimulationReport>(both->first) : both.error();
  }
  Result<ContactReport> contactReport() override {
    const auto both = reports();
    return both ? Result<ContactReport>(both->second) : both.error();
  }
  std::map<std::string, double> stageMilliseconds() const override { return facts().stages; }
  bool tellsTimesOfFrames() const override { return false; }
  std::size_t rigidStrandCount() const override { return facts().rigidStrandCount; }
  std::vector<std::string> warnings() const override { return facts().warnings; }
  std::vector<std::string> deviceMessages() const override { return facts().messages; }
  std::string device() const override { return facts().device; }
  std::string driver() const override { return facts().driver; }
  std::string kernel() const override { return facts().kernel; }
  bool isTuned() const override { return facts().isTuned; }
  double compileMilliseconds() const override { return facts().compileMilliseconds; }
  std::optional<std::uint64_t> deviceBytes() const override { return facts().deviceBytes; }

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
  Result<std::pair<SimulationReport, ContactReport>> reports() const {
    std::vector<std::byte> bytes;
    if (Status asked = ask(begin(Call::reports), &bytes); !asked) return asked.error();
    Archive archive = givenIn(bytes);
    std::pair<SimulationReport, ContactReport> both;
    archive.value(both.first), archive.value(both.second);
    return both;
  }
  Facts facts() const {
    std::vector<std::byte> bytes;
    Facts facts;
    if (!ask(begin(Call::facts), &bytes)) return facts;
    Archive archive = givenIn(bytes);
    facts.archive(archive);
    return facts;
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
  Server(Backend& hair, const RankScene& scene)
      : hair_(hair), scene_(scene), whole_(scene.pointCount), own_(scene.points.size()) {}

  Status answer(Archive& call, Archive& given) {
    Call which{};
    call.value(which);
    switch (which) {
      case Call::submitFrame: {
        std::vector<HeadPose> heads;
        std::vector<BodyPose> bodies, roots;
        call.list(heads), call.list(bodies), call.list(roots);
        return hair_.submitFrame(heads, bodies, roots);
      }
      case Call::waitFrame: {
        if (Status waited = hair_.waitFrame(); !waited) return waited;
        hair_.framePositions(whole_);
        takeOwn(whole_);
        given.list(own_);
        return {};
      }
      case Call::change:
        return change(call);
      case Call::setFields: {
        std::vector<ForceField> fields, from;
        archiveFields(call, fields, scene_.fields), archiveFields(call, from, scene_.fields);
        return hair_.setFields(fields, from);
      }
      case Call::setGoals: {
        std::vector<Vec3f> places, from;
        std::vector<float> strengths;
        double dampingRatio = 0;
        call.list(places), call.list(strengths), call.value(dampingRatio), call.list(from);
        return hair_.setGoals(places, strengths, dampingRatio, from);
      }
      case Call::positions: {
        const auto all = hair_.positions();
        if (!all) return all.error();
        takeOwn(*all);
        given.list(own_);
        return {};
      }
      case Call::checkpoint:
        return give(hair_.checkpoint(), given);
      case Call::restore: {
        std::vector<std::byte> bytes;
        call.list(bytes);
        return hair_.restore(bytes);
      }
      case Call::reports:
        return giveReports(given);
      case Call::facts:
        Facts::of(hair_).archive(given);
        return {};
      case Call::leave:
        break;
    }
    return Error{"rank 0 is another ringlet"};
  }

 private:
  Status change(Archive& call) {
    double keysAt = 0;
    call.value(keysAt);
    const auto numbers = scene_.numbersAt(keysAt);
    if (!numbers) return numbers.error();
    return hair_.change(numbers->settings, numbers->material, keysAt);
  }
  void takeOwn(std::span<const Vec3f> all) {
    for (std::size_t k = 0; k < own_.size(); ++k) own_[k] = all[scene_.points[k]];
  }
  template <class T>
  static Status give(Result<std::vector<T>> values, Archive& given) {
    if (!values) return values.error();
    given.list(*values);
    return {};
  }
  Status giveReports(Archive& given) {
    auto report = hair_.report();
    if (!report) return report.error();
    auto contacts = hair_.contactReport();
    if (!contacts) return contacts.error();
    given.value(*report), given.value(*contacts);
    return {};
  }

  Backend& hair_;
  const RankScene& scene_;
  std::vector<Vec3f> whole_, own_;  // positions of the groom, of which some are known, and of the part
};

// What is given comes after this.
Archive beginAnswer(std::string why = "") {
  Archive answer = Archive::writing();
  answer.text(why);
  return answer;
}

}  // namespace

std::vector<std::uint32_t> pointsOf(const Groom& groom, std::span<const std::uint32_t> strands) {
  std::vector<std::uint32_t> points;
  for (const std::uint32_t s : strands)
    for (std::uint32_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i) points.push_back(i);
  return points;
}

Result<std::unique_ptr<Backend>> makeRemoteBackend(int rank, const Groom& groom,
                                                   std::span<const std::uint32_t> strands) {
  auto made = std::make_unique<RemoteBackend>(rank, groom.points.size(), pointsOf(groom, strands));
  std::vector<std::byte> nothing;
  if (Status ready = made->answer(nothing); !ready)
    return Error{fmt::format("rank {}: {}", rank, ready.error().message)};
  return std::unique_ptr<Backend>(std::move(made));
}

void serve(Result<std::unique_ptr<Backend>> hair, const RankScene& scene) {
  if (isToldToLeave()) return;
  sendTo(0, beginAnswer(hair ? "" : hair.error().message).take());
  try {
    std::optional<Server> server;
    if (hair) server.emplace(**hair, scene);
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

}  // namespace ringlet::program
