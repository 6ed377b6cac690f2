// Implements motion/bvh_file.h.
#include "ringlet/motion/bvh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <new>
#include <numbers>

#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/motion/joint_name.h"

namespace ringlet {
namespace {

using Channel = BvhJoint::Channel;

// A word and the line it stands on; braces and colons are words of their own.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) { advance(); }

  std::string_view word() const { return word_; }  // empty at the end
  std::size_t line() const { return line_; }
  std::string_view take() {
    const std::string_view taken = word_;
    advance();
    return taken;
  }
  Error error(std::string_view expected) const {
    return Error{word_.empty()
                     ? fmt::format("line {}: the file ends where {} should stand", line_, expected)
                     : fmt::format("line {}: {} should stand where {} is", line_, expected, quoted(word_))};
  }
  Status expect(std::string_view expected) {
    if (word_ != expected) return error(fmt::format("\"{}\"", expected));
    advance();
    return {};
  }
  Result<double> number(std::string_view what) {
    double value = 0;
    const char* begin = word_.data() + (word_.starts_with('+') ? 1 : 0);
    const char* end = word_.data() + word_.size();
    const auto [stopped, code] = std::from_chars(begin, end, value);
    if (word_.empty() || code != std::errc{} || stopped != end || !std::isfinite(value)) return error(what);
    advance();
    return value;
  }

 private:
  static bool isMark(char c) { return c == '{' || c == '}' || c == ':'; }
  static bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
  }

  void advance() {
    while (at_ < text_.size() && isSpace(text_[at_])) line_ += text_[at_++] == '\n' ? 1 : 0;
    const std::size_t start = at_;
    if (at_ < text_.size() && isMark(text_[at_])) ++at_;
    while (at_ > start || at_ < text_.size()) {
      if (at_ == text_.size() || isSpace(text_[at_]) || isMark(text_[at_]) ||
          (at_ > start && isMark(text_[start])))
        break;
      ++at_;
    }
    word_ = text_.substr(start, at_ - start);
  }

  std::string_view text_, word_;
  std::size_t at_ = 0, line_ = 1;
};

std::optional<Channel> channelNamed(std::string_view name) {
  constexpr std::array<std::string_view, 6> kNames{"Xposition", "Yposition", "Zposition",
                                                   "Xrotation", "Yrotation", "Zrotation"};
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Channel>(found - kNames.begin());
}

Status readOffset(Words& words, BvhJoint& joint) {
  if (Status status = words.expect("OFFSET"); !status) return status;
  for (double* x : {&joint.offset.x, &joint.offset.y, &joint.offset.z}) {
    auto number = words.number("a number of an offset");
    if (!number) return number.error();
    *x = *number;
  }
  return {};
}

Status readChannels(Words& words, BvhFile& file, BvhJoint& joint) {
  joint.firstChannel = file.channelCount;
  if (words.word() != "CHANNELS") return {};
  words.take();
  auto count = words.number("a number of channels");
  if (!count) return count.error();
  if (!(*count >= 0 && *count <= 6 && *count == std::floor(*count)))
    return Error{fmt::format("line {}: a joint has 0 to 6 channels, not {}", words.line(), *count)};
  for (int k = 0; k < static_cast<int>(*count); ++k) {
    const auto channel = channelNamed(words.word());
    if (!channel) return words.error("a channel, Xposition to Zrotation,");
    joint.channels.push_back(*channel);
    words.take();
  }
  file.channelCount += joint.channels.size();
  return {};
}

// Names may hold spaces, and even colons: all words before the brace.
std::string readName(Words& words) {
  std::string name;
  while (!words.word().empty() && words.word() != "{") {
    const std::string_view word = words.take();
    if (!name.empty() && word != ":" && name.back() != ':') name += ' ';
    name += word;
  }
  return name;
}

Status readHierarchy(Words& words, BvhFile& file) {
  if (Status status = words.expect("HIERARCHY"); !status) return status;
  if (words.word() != "ROOT") return words.error("\"ROOT\"");
  std::vector<std::size_t> open;  // joints whose braces are
  do {
    if (words.word() == "}") {
      words.take();
      open.pop_back();
      continue;
    }
    const bool isEnd = words.word() == "End";
    if (!isEnd && words.word() != (open.empty() ? "ROOT" : "JOINT"))
      return words.error("\"JOINT\", \"End Site\" or \"}\"");
    words.take();
    BvhJoint joint;
    joint.name = readName(words);
    if (isEnd) joint.name.clear();
    joint.parent = open.empty() ? file.joints.size() : open.back();
    if (Status status = words.expect("{"); !status) return status;
    if (Status status = readOffset(words, joint); !status) return status;
    if (Status status = readChannels(words, file, joint); !status) return status;
    open.push_back(file.joints.size());
    file.joints.push_back(std::move(joint));
  } while (!open.empty());
  return {};
}

// Exporters miscount: what is there is read, up to what is stated, as long as the last frame is whole.
Status readFrames(Words& words, BvhFile& file) {
  const std::size_t stated = file.statedFrameCount, width = file.channelCount;
  std::size_t count = 0;
  for (; !words.word().empty(); ++count) {
    auto value = words.number("a number");
    if (!value) {
      return Error{fmt::format("frame {} of {}, number {} of {}: {}", count / width + 1, stated,
                               count % width + 1, width, value.error().message)};
    }
    if (count / width < stated) file.values.push_back(*value);
  }
  file.foundFrameCount = count / width;
  if (count % width != 0) {
    return Error{fmt::format(
        "line {}: frame {} has {} of its {} numbers; the file states {} frames and holds {} and a part of "
        "one",
        words.line(), file.foundFrameCount + 1, count % width, width, stated, file.foundFrameCount)};
  }
  if (file.foundFrameCount == 0)
    return Error{fmt::format("line {}: the file states {} frames and holds none", words.line(), stated)};
  return {};
}

Status readMotion(Words& words, BvhFile& file) {
  for (const char* word : {"MOTION", "Frames", ":"}) {
    if (Status status = words.expect(word); !status) return status;
  }
  auto frames = words.number("the number of frames");
  if (!frames) return frames.error();
  if (!(*frames >= 1 && *frames <= 1e8 && *frames == std::floor(*frames)))
    return Error{fmt::format(
        "line {}: a motion has 1 to 1e8 frames, not {}; the number there is that of the lines of numbers "
        "which follow",
        words.line(), *frames)};
  for (const char* word : {"Frame", "Time", ":"}) {
    if (Status status = words.expect(word); !status) return status;
  }
  auto seconds = words.number("the time of a frame");
  if (!seconds) return seconds.error();
  if (!(*seconds > 0))
    return Error{fmt::format("line {}: a frame takes {} s; it must be above 0", words.line(), *seconds)};
  if (file.channelCount == 0) return Error{"the skeleton has no channels, so nothing moves"};
  file.frameSeconds = *seconds;
  file.statedFrameCount = static_cast<std::size_t>(*frames);
  return readFrames(words, file);
}

}  // namespace

Vec3d BvhFile::placeIn(std::size_t frame, std::size_t j) const {
  const BvhJoint& joint = joints[j];
  Vec3d place = joint.offset;
  for (std::size_t k = 0; k < joint.channels.size(); ++k) {
    const double value = values[frame * channelCount + joint.firstChannel + k];
    if (joint.channels[k] == Channel::xPosition) place.x = value;
    if (joint.channels[k] == Channel::yPosition) place.y = value;
    if (joint.channels[k] == Channel::zPosition) place.z = value;
  }
  return place;
}

Quatd BvhFile::turnIn(std::size_t frame, std::size_t j) const {
  const BvhJoint& joint = joints[j];
  Quatd turn;
  for (std::size_t k = 0; k < joint.channels.size(); ++k) {
    const double angle = values[frame * channelCount + joint.firstChannel + k] * std::numbers::pi / 180;
    if (joint.channels[k] == Channel::xRotation) turn = turn * fromRotationVector(Vec3d{angle, 0, 0});
    if (joint.channels[k] == Channel::yRotation) turn = turn * fromRotationVector(Vec3d{0, angle, 0});
    if (joint.channels[k] == Channel::zRotation) turn = turn * fromRotationVector(Vec3d{0, 0, angle});
  }
  return turn;
}

std::vector<Vec3d> BvhFile::placesAt(std::size_t frame) const {
  std::vector<Vec3d> places;
  std::vector<Quatd> turns;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::size_t parent = joints[j].parent;
    const Quatd before = parent == j ? Quatd{} : turns[parent];
    places.push_back((parent == j ? Vec3d{} : places[parent]) + rotate(before, placeIn(frame, j)));
    turns.push_back(normalized(before * turnIn(frame, j)));
  }
  return places;
}

std::vector<std::string> BvhFile::names() const {
  std::vector<std::string> all;
  for (const BvhJoint& joint : joints) all.push_back(joint.name);
  return all;
}

std::optional<std::size_t> BvhFile::find(std::string_view name) const { return findJoint(names(), name); }

Keyframes BvhFile::motionOf(std::size_t joint, double metresPerUnit, std::size_t firstFrame) const {
  std::vector<std::size_t> chain{joint};  // from the joint to the root
  while (joints[chain.back()].parent != chain.back()) chain.push_back(joints[chain.back()].parent);
  std::ranges::reverse(chain);

  Keyframes motion{frameSeconds, {}};
  for (std::size_t frame = firstFrame; frame < frameCount(); ++frame) {
    HeadPose pose;
    for (std::size_t j : chain) {
      pose.position += rotate(pose.rotation, placeIn(frame, j) * metresPerUnit);
      pose.rotation = normalized(pose.rotation * turnIn(frame, j));
    }
    motion.poses.push_back(pose);
  }
  return motion;
}

Result<BvhFile> parseBvh(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  Words words(text);
  BvhFile file;
  if (Status status = readHierarchy(words, file); !status) return status.error();
  if (Status status = readMotion(words, file); !status) return status.error();
  return file;
}

Result<BvhFile> readBvh(const std::filesystem::path& path) try {
  auto bytes = readWholeFile(path);
  if (!bytes) return bytes.error();
  auto file = parseBvh({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (!file) return Error{fmt::format("{} is no BVH motion: {}", path.string(), file.error().message)};
  return file;
} catch (const std::bad_alloc&) {
  return Error{fmt::format("{}: there is not enough memory for it", path.string())};
}

}  // namespace ringlet
