// Implements growing_report.h.
#include "program/cli/growing_report.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "ringlet/base/whole_file.h"

namespace ringlet::program {
namespace {

// Text that is not UTF-8, for example in a driver's name, is replaced; it is no error.
std::string textOf(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

GrowingReport::GrowingReport(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path_, ignored);
  isReplaced_ = !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
}

Status GrowingReport::grow(const nlohmann::ordered_json& json) const {
  if (path_.empty() || !isReplaced_) return {};
  const std::string text = textOf(json);
  return writeWholeFile(path_, std::as_bytes(std::span(text)));
}

Status GrowingReport::finish(const nlohmann::ordered_json& json) const {
  if (path_.empty() || isReplaced_) return grow(json);
  std::ofstream file(path_);
  file << textOf(json);
  file.close();
  if (file) return {};
  return Error{fmt::format("cannot write {}", path_.string()), Fault::output};
}

}  // namespace ringlet::program
