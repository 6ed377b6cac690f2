// Implements sweep_record.h.
#include "program/sweep/sweep_record.h"

#include <fmt/format.h>

#include <span>
#include <string>
#include <system_error>

#include "ringlet/base/whole_file.h"

namespace ringlet::program {

Status writeRecord(const std::filesystem::path& path, const SweepRecord& record) {
  nlohmann::ordered_json json = record.report;
  for (const RunFact& fact : record.facts) json["facts"].push_back({fact.name, fact.value});
  const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  return writeWholeFile(path, std::as_bytes(std::span<const char>(text)));
}

Result<std::optional<SweepRecord>> readRecord(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) return std::optional<SweepRecord>();
  const auto bytes = readWholeFile(path);
  if (!bytes) return bytes.error();
  const auto* text = reinterpret_cast<const char*>(bytes->data());
  SweepRecord record;
  record.report = nlohmann::ordered_json::parse(text, text + bytes->size(), nullptr, false);
  const bool isRecord = record.report.is_object() && record.report.contains("facts") &&
                        record.report["facts"].is_array() && record.report.contains("positions_hash");
  const Error broken{
      fmt::format("{} is no record of a run; remove it, or --overwrite runs all anew", path.string()),
      Fault::input};
  if (!isRecord) return broken;
  for (const auto& fact : record.report["facts"]) {
    if (!fact.is_array() || fact.size() != 2 || !fact[0].is_string() || !fact[1].is_string()) return broken;
    record.facts.push_back({fact[0], fact[1]});
  }
  record.report.erase("facts");
  return std::optional(std::move(record));
}

}  // namespace ringlet::program
