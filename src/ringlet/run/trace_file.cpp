// Implements run/trace_file.h.
#include "ringlet/run/trace_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace ringlet {
namespace {

constexpr const char* kRowNames =
    R"([
{"ph":"M","pid":1,"tid":1,"name":"thread_name","args":{"name":"frames"}},
{"ph":"M","pid":1,"tid":2,"name":"thread_name","args":{"name":"dispatches"}})";

// An event; converts milliseconds to the format's microseconds.
std::string event(int row, const std::string& name, double begin, double milliseconds) {
  return fmt::format(",\n{{\"ph\":\"X\",\"pid\":1,\"tid\":{},\"name\":\"{}\",\"ts\":{:.3f},\"dur\":{:.3f}}}",
                     row, name, 1000 * begin, 1000 * milliseconds);
}

}  // namespace

Result<TraceFile> TraceFile::create(const std::filesystem::path& path) {
  TraceFile trace(path);
  trace.file_ << kRowNames;
  if (!trace.file_.flush())
    return Error{fmt::format("could not write {}; is its folder there and writable?", path.string()),
                 Fault::output};
  return trace;
}

void TraceFile::addFrame(int number, std::span<const StageSpan> stages) {
  if (stages.empty()) return;
  double end = stages.front().begin;
  for (const StageSpan& span : stages) end = std::max(end, span.begin + span.milliseconds);
  file_ << event(1, fmt::format("frame {}", number), stages.front().begin, end - stages.front().begin);
  for (const StageSpan& span : stages) file_ << event(2, span.stage, span.begin, span.milliseconds);
}

Status TraceFile::finish() {
  file_ << "\n]\n";
  if (!file_.flush())
    return Error{fmt::format("could not write {}; is the disk full?", path_.string()), Fault::output};
  return {};
}

}  // namespace ringlet
