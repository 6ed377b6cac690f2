// Rows of a report's table: a key of its JSON object, what the key means and how its value is read. The
// object and the list of keys in a help are made of the same rows, so that no key is without its meaning.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <vector>

#include "ringlet/run/run_report.h"

namespace ringlet {

using ReportJson = nlohmann::ordered_json;

template <class Source>
struct ReportRow {
  ReportKey key;
  ReportJson (*value)(const Source& from);
  bool (*isThere)(const Source& from) = nullptr;  // none: always
};

/// The keys of a table, of ReportRow or of another row with a `key`.
template <const auto& rows>
std::vector<ReportKey> keysOf() {
  std::vector<ReportKey> keys;
  for (const auto& row : rows) keys.push_back(row.key);
  return keys;
}

/// Adds what the rows of a table say.
template <const auto& rows, class Source>
void addRows(ReportJson& json, const Source& from) {
  for (const ReportRow<Source>& row : rows)
    if (!row.isThere || row.isThere(from)) json[row.key.key] = row.value(from);
}

/// An object of these.
template <const auto& rows, class Source>
ReportJson objectOf(const Source& from) {
  ReportJson json;
  addRows<rows>(json, from);
  return json;
}

template <class T>
ReportJson orNull(const std::optional<T>& value) {
  return value ? ReportJson(*value) : ReportJson();
}

inline ReportJson pathsOf(const std::vector<std::filesystem::path>& paths) {
  ReportJson json = ReportJson::array();
  for (const auto& path : paths) json.push_back(path.string());
  return json;
}

}  // namespace ringlet
