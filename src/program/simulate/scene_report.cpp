// Implements scene_report.h.
#include "program/simulate/scene_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "program/cli/keys_help.h"
#include "program/measure/measure_report.h"
#include "ringlet/run/report_rows.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::program {
namespace {

using Json = ReportJson;

constexpr ReportRow<SceneReport> kSceneRows[] = {
    {{"scene", "", "Its name."}, [](const SceneReport& f) -> Json { return f.scene.name; }},
    {{"seconds", "s", "Length of what was run."},
     [](const SceneReport& f) -> Json { return f.outcome.frameCount / f.scene.settings.framesPerSecond; }},
    {{"preload", "1", "Share of gravity balanced in the rest pose."},
     [](const SceneReport& f) -> Json { return f.scene.settings.gravityPreload; }},
    {{"core", "", "Whether there is a core spring."}, [](const SceneReport& f) -> Json { return f.hasCore; }},
    {{"frames_on", "", "smoothed or raw: the strand that frames are on."},
     [](const SceneReport& f) -> Json { return f.framesOn; }},
};

constexpr ReportRow<SceneReport> kFrameTurnRows[] = {
    {{"frame_turn_deg", "deg",
      "The largest turn of a strand frame in one step: of twist_jump, which runs twice for it, null elsewhere."},
     [](const SceneReport& f) { return orNull(f.numbers.frameTurn); }},
};

constexpr ReportRow<BuiltinScene> kListRows[] = {
    {{"name", "", "Its name."}, [](const BuiltinScene& f) -> Json { return f.name; }},
    {{"summary", "", "What it shows."}, [](const BuiltinScene& f) -> Json { return f.summary; }},
    {{"seconds", "s", "Its length."}, [](const BuiltinScene& f) -> Json { return f.seconds; }},
    {{"preload", "1", "Share of gravity balanced in the rest pose."},
     [](const BuiltinScene& f) -> Json { return f.settings.gravityPreload; }},
};

constexpr ReportRow<SceneKey> kKeyRows[] = {
    {{"table", "", "The table it is in."}, [](const SceneKey& f) -> Json { return f.table; }},
    {{"key", "", "Its name."}, [](const SceneKey& f) -> Json { return f.key; }},
    {{"type", "", "What its value is."}, [](const SceneKey& f) -> Json { return f.type; }},
    {{"unit", "", "In which unit."}, [](const SceneKey& f) -> Json { return f.unit; }},
    {{"range", "", "From which number to which."}, [](const SceneKey& f) -> Json { return f.range; }},
    {{"default", "", "What holds without it, in words where it is no value."},
     [](const SceneKey& f) -> Json { return f.standard; }},
    {{"only_with", "", "The kinds, shapes or sources that have it; empty for all."},
     [](const SceneKey& f) -> Json { return f.onlyWith; }},
    {{"effect", "", "What it does, a sentence."}, [](const SceneKey& f) -> Json { return f.effect; }},
};

constexpr ReportRow<WrittenScene> kWrittenRows[] = {
    {{"scene", "", "Its name."}, [](const WrittenScene& f) -> Json { return f.scene; }},
    {{"outputs", "", "The scene file and its groom."},
     [](const WrittenScene& f) { return pathsOf(f.files); }},
};

constexpr ReportKey kListKey{"scenes", "", "The scenes.", keysOf<kListRows>};
constexpr ReportKey kKeysKey{"keys", "", "The keys of a scene file.", keysOf<kKeyRows>};

}  // namespace

nlohmann::ordered_json sceneJson(const SceneReport& report) {
  Json json = objectOf<kSceneRows>(report);
  json.update(runJson(report.names, report.scene.settings, report.outcome));
  // Where both know a number, the run's is that of every step.
  Json curl;
  addCurlKeys(curl, report.numbers.curl);
  curl.erase("max_edge_stretch");
  json.update(curl);
  addRows<kFrameTurnRows>(json, report);
  return json;
}

std::string sceneMeasureText(const SceneNumbers& numbers, const Settings& settings) {
  const CurlNumbers& curl = numbers.curl;
  std::string text = fmt::format("  droop         {} mm at the end, {} mm at the worst frame{}\n",
                                 shown(1000 * curl.droop, 4), shown(1000 * curl.worstDroop, 4),
                                 riseNote(std::min(curl.droop, curl.worstDroop)));
  text += fmt::format("  core          {} x its length at rest, {} x at the worst frame\n",
                      shown(curl.coreElongation, 4), shown(curl.worstCoreElongation, 4));
  text += curl.meanRadius == 0
              ? fmt::format("  curl          none at rest, arc drift {:.2e}\n", curl.arcDrift)
              : fmt::format("  curl          {} turns of radius {} mm, hand {}, arc drift {:.2e}\n",
                            shown(curl.turns, 3), shown(1000 * curl.meanRadius, 3),
                            curl.handednessKept ? "kept" : "not kept", curl.arcDrift);
  text += fmt::format("  tip           turned by {} degrees, {} at the worst frame\n",
                      shown(curl.tipRotation, 2), shown(curl.worstTipRotation, 2));
  text += fmt::format(
      "  bounce        {}, {}, energy left of its peak {:.3g}\n",
      curl.bounceHz ? fmt::format("{} Hz", shown(curl.bounceHz, 2)) : "none measured",
      curl.settleSeconds ? fmt::format("settled after {} s", shown(curl.settleSeconds, 2)) : "not settled",
      curl.energyRatio.value_or(0));
  if (numbers.residual)
    text += fmt::format("  residual      {:.2e} of the velocity solve\n", *numbers.residual);
  if (numbers.frameTurn) {
    text += fmt::format("  frames        turned by at most {} degrees in a step of 1/{:.6g} s\n",
                        shown(numbers.frameTurn, 2), 1 / settings.stepSeconds());
  }
  return text;
}

nlohmann::ordered_json sceneListJson() {
  Json scenes = Json::array();
  for (const std::string& name : sceneNames()) scenes.push_back(objectOf<kListRows>(*makeScene(name)));
  return {{kListKey.key, scenes}};
}

nlohmann::ordered_json sceneKeysJson() {
  Json keys = Json::array();
  for (const SceneKey& key : sceneKeys()) keys.push_back(objectOf<kKeyRows>(key));
  return {{kKeysKey.key, keys}};
}

nlohmann::ordered_json writtenJson(const WrittenScene& written) { return objectOf<kWrittenRows>(written); }

std::string sceneReportsHelp() {
  std::vector<ReportKey> own = keysOf<kSceneRows>();
  own.push_back(kFrameTurnRows[0].key);
  return keysHelp(own, "--json keys beside those:") + keysHelp({kListKey}, "--json keys with --list:") +
         keysHelp({kKeysKey}, "--json keys with --keys:") +
         keysHelp(keysOf<kWrittenRows>(), "--json keys with --write:");
}

}  // namespace ringlet::program
