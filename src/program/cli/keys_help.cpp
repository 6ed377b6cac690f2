// Implements keys_help.h.
#include "program/cli/keys_help.h"

#include <fmt/format.h>

#include <map>
#include <string_view>

namespace ringlet::program {
namespace {

// Where the keys of an object stand already: by what lists them, the key that holds it.
using Listed = std::map<decltype(ReportKey::parts), std::string>;

std::string keyLines(const std::vector<ReportKey>& keys, const std::string& indent, Listed& listed) {
  std::string text;
  for (const ReportKey& key : keys) {
    const std::string_view unit = key.unit;
    const bool isNew = key.parts && listed.emplace(key.parts, key.key).second;
    text += fmt::format("  {:<26}{}{}{}\n", indent + key.key, key.effect,
                        key.parts && !isNew ? fmt::format(" (the keys of {})", listed[key.parts]) : "",
                        unit.empty() || unit == "1" ? "" : fmt::format(" [{}]", unit));
    if (isNew) text += keyLines(key.parts(), indent + "  ", listed);
  }
  return text;
}

}  // namespace

std::string keysHelp(const std::vector<ReportKey>& keys, const std::string& heading) {
  Listed listed;
  return heading + "\n" + keyLines(keys, "", listed);
}

}  // namespace ringlet::program
