// Sentences of the library's in Python's words, which print as they are.
#pragma once

#include <string>
#include <vector>

#include "python/binding.h"
#include "ringlet/base/host_words.h"
#include "ringlet/base/result.h"
#include "ringlet/base/shown_text.h"

namespace ringlet::python {

/// Of read_groom and of what looks at a groom.
inline constexpr HostWord kGroomWords[] = {
    {"unit", "metres_per_unit", "metres_per_unit={}"},
    {"up", "up", "up=\"{}\""},
    {"root-end", "root_end", "root_end=\"{}\""},
    {"points-per-strand", "points_per_strand", "points_per_strand={}"},
};
/// Of Motion.load.
inline constexpr HostWord kMotionWords[] = {
    {"motion-unit", "metres_per_unit", "metres_per_unit={}"},
    {"motion-up", "file_up", "file_up=\"{}\""},
};

/// Sentences each by `say`, a function from a sentence to one.
template <class Say>
std::vector<std::string> sentencesBy(Say&& say, std::vector<std::string> sentences) {
  for (std::string& sentence : sentences) sentence = shownText(say(sentence));
  return sentences;
}
inline std::vector<std::string> inWords(std::span<const HostWord> words, std::vector<std::string> sentences) {
  return sentencesBy([&](const std::string& s) { return inHostWords(s, words); }, std::move(sentences));
}
inline std::vector<std::string> inSceneWords(std::vector<std::string> sentences) {
  return sentencesBy([](const std::string& s) { return ringlet::inSceneWords(s); }, std::move(sentences));
}
/// As valueOf, of a scene, of all that it names and of its run.
template <class T>
T sceneValueOf(Result<T> result) {
  if (!result) throw Failure(ringlet::inSceneWords(result.error()));
  return std::move(*result);
}
inline void demandScene(const Status& status) {
  if (!status) throw Failure(ringlet::inSceneWords(status.error()));
}
template <class T>
Result<T> inWords(std::span<const HostWord> words, Result<T> result) {
  if (result) return result;
  return Error{inHostWords(result.error().message, words), result.error().fault};
}

}  // namespace ringlet::python
