// Implements kernels_child.h.
#include "program/device/kernels_child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "ringlet/base/stopwatch.h"

namespace ringlet::program {
namespace {

using Json = nlohmann::ordered_json;

// The output and the wait status of the child.
struct Ended {
  std::string output;
  int status = 0;
};

// Switches Mesa's cache of compiled kernels off, so that times are those of a first use. What a crashing
// driver prints is dropped; the parent reports the signal.
Result<Ended> runChild(const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return Error{fmt::format("cannot make a pipe: {}", std::strerror(errno))};
  std::vector<std::string> all{"ringlet"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& argument : all) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  std::fflush(stdout);
  const pid_t child = fork();
  if (child < 0) return Error{fmt::format("cannot start a process: {}", std::strerror(errno))};
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    close(ends[0]);
    close(ends[1]);
    setenv("MESA_SHADER_CACHE_DISABLE", "1", 0);
    execv("/proc/self/exe", pointers.data());
    _exit(127);
  }
  close(ends[1]);
  Ended ended;
  std::array<char, 4096> part{};
  for (ssize_t size = 0; (size = read(ends[0], part.data(), part.size())) > 0;)
    ended.output.append(part.data(), static_cast<std::size_t>(size));
  close(ends[0]);
  waitpid(child, &ended.status, 0);
  return ended;
}

}  // namespace

CompiledKernel compileKernel(const ComputeDevice& device, const ListedKernel& kernel) {
  CompiledKernel compiled;
  double milliseconds = 0;
  const auto made = [&] {
    const Stopwatch watch(milliseconds);
    return gpu::Kernel::create(device.gpu(), kernel.description);
  }();
  compiled.seconds = milliseconds / 1000;
  compiled.isCompiled = static_cast<bool>(made);
  if (!made) {
    compiled.trouble = made.error().message;
    return compiled;
  }
  if ((*made)->hasFullSubgroups()) compiled.subgroup = (*made)->subgroupSize();
  const auto executables = gpu::executablesOf(**made);
  if (!executables) {
    compiled.trouble = executables.error().message;
    return compiled;
  }
  if (!executables->empty()) {
    compiled.subgroup = executables->front().subgroupSize;
    compiled.statistics = executables->front().statistics;
  }
  return compiled;
}

void printCompiled(const CompiledKernel& compiled) {
  Json json{{"is_compiled", compiled.isCompiled},
            {"trouble", compiled.trouble},
            {"subgroup", compiled.subgroup ? Json(*compiled.subgroup) : Json()},
            {"seconds", compiled.seconds},
            {"statistics", Json::array()}};
  for (const gpu::KernelStatistic& one : compiled.statistics)
    json["statistics"].push_back({{"name", one.name}, {"value", one.value}});
  fmt::print("{}\n", json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

CompiledKernel compileInChild(const std::vector<std::string>& arguments) {
  CompiledKernel compiled;
  const auto ended = runChild(arguments);
  if (!ended) {
    compiled.trouble = ended.error().message;
    return compiled;
  }
  if (WIFSIGNALED(ended->status)) {
    compiled.trouble = fmt::format("the driver crashed ({})", strsignal(WTERMSIG(ended->status)));
    return compiled;
  }
  const Json json = Json::parse(ended->output, nullptr, false);
  if (json.is_discarded() || !json.is_object()) {
    compiled.trouble =
        fmt::format("the process that compiles it ended with status {}", WEXITSTATUS(ended->status));
    return compiled;
  }
  compiled.isCompiled = json["is_compiled"];
  compiled.trouble = json["trouble"];
  if (!json["subgroup"].is_null()) compiled.subgroup = json["subgroup"].get<std::uint32_t>();
  compiled.seconds = json["seconds"];
  for (const Json& one : json["statistics"]) compiled.statistics.push_back({one["name"], one["value"]});
  return compiled;
}

}  // namespace ringlet::program
