// Implements standard_output.h.
#include "program/cli/standard_output.h"

#include <nlohmann/json.hpp>

namespace ringlet::program {

void printJson(const nlohmann::ordered_json& json) {
  fmt::print("{}\n", shownJson(json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace)));
}

}  // namespace ringlet::program
