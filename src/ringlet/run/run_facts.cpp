// Implements run_facts.h.
#include "ringlet/run/run_facts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "ringlet/base/whole_file.h"
#include "ringlet/motion/gltf_buffers.h"
#include "ringlet/motion/mesh_motion_file.h"
#include "ringlet/motion/motion_file.h"
#include "ringlet/motion/usd_clip_files.h"
#include "ringlet/motion/usd_mesh.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/rest/material_file.h"
#include "ringlet/run/run_folder.h"
#include "ringlet/scenes/load/scene_paths.h"

namespace ringlet {
namespace {

namespace fs = std::filesystem;

// Adds a fact for each line of TOML as Ringlet writes it: "key = value  # what it is" below "[table]".
void addLines(std::string_view text, std::string table, std::vector<RunFact>& facts) {
  std::map<std::string, int, std::less<>> tablesOfList;  // by the list's name
  std::size_t lineOfTable = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++lineOfTable;
    line = line.substr(0, line.find("  #"));
    if (line.empty() || line.starts_with('#')) continue;
    if (line.starts_with('[')) {
      // Tables of a list have the same name, so they are numbered from 1.
      table = line;
      if (line.starts_with("[[")) table += fmt::format(" {}", ++tablesOfList[table]);
      lineOfTable = 0;
      continue;
    }
    const std::size_t equals = line.find(" = ");
    if (equals == std::string_view::npos) {
      facts.push_back({fmt::format("{} line {}", table, lineOfTable), std::string(line)});
    } else {
      facts.push_back(
          {fmt::format("{} {}", table, line.substr(0, equals)), std::string(line.substr(equals + 3))});
    }
  }
}

}  // namespace

std::vector<fs::path> inputFilesOf(const fs::path& input, const SceneFile& scene) {
  SceneFile asked = scene;
  asked.cameras.clear();  // they have no effect on hair
  std::set<fs::path> files;
  const auto add = [&](const fs::path& file) { files.insert(file); };
  if (!input.empty()) add(input);
  forEachFileOf(std::as_const(asked), add);
  // USD files name value clips. No other file that a scene names refers to further files. A scalp may be
  // glTF, whatever its ending.
  for (const fs::path& file : std::vector(files.begin(), files.end())) {
    if (file == scene.start.from) {
      if (const auto animation = animationFileOf(file)) {
        files.erase(file);
        files.insert(*animation);
      }
    }
    if (isMeshSequence(file)) {
      files.erase(file);
      std::ranges::for_each(meshSequenceFiles(file), add);
    }
    if (file == scene.scalp.file || motionFileKind(file.string()) == MotionFileKind::gltf)
      std::ranges::for_each(gltfBufferFiles(file), add);
    if (isUsdFile(file)) std::ranges::for_each(usdClipFilesOf(file), add);
  }
  return {files.begin(), files.end()};
}

Result<std::vector<RunFact>> factsOf(const SceneFile& scene, const std::vector<fs::path>& inputs) {
  SceneFile asked = scene;
  asked.hasMaterial = false;  // see addMaterialFacts
  asked.output = {};          // see addOutputFacts
  asked.cameras.clear();      // they have no effect on hair
  std::vector<RunFact> facts;
  addLines(sceneText(asked), "", facts);
  for (const fs::path& input : inputs) {
    if (isSceneFile(input)) continue;  // its keys are facts already
    const auto bytes = readWholeFile(input);
    if (!bytes) return bytes.error();
    const auto* data = reinterpret_cast<const Bytef*>(bytes->data());
    facts.push_back(
        {fmt::format("the content of {}", input.string()),
         fmt::format("{} bytes with CRC-32 {:08x}", bytes->size(), crc32_z(0, data, bytes->size()))});
  }
  return facts;
}

Status prepareRun(const SceneFile& scene, const fs::path& input, std::optional<LoadedGroom>& origin,
                  RunOptions& options) {
  const std::vector<fs::path> inputs = inputFilesOf(input, scene);
  if (Status stays = checkInputsStay(inputs, outputsOf(options), options.words); !stays) return stays;
  if (needsOrigin(scene.output)) {
    auto read = loadGroom(scene.groom, true);
    if (!read) return read.error();
    origin = std::move(*read);
    if (Status chosen = chooseOrigin(*origin, options); !chosen) return chosen;
  }
  const bool goesOn =
      options.leftovers == Leftovers::resume || options.leftovers == Leftovers::resumeOrOverwrite;
  if (options.checkpointFrames == 0 && !goesOn) return {};
  auto facts = factsOf(scene, inputs);
  if (!facts) return facts.error();
  options.facts = std::move(*facts);
  return {};
}

void addMaterialFacts(const Material& material, std::vector<RunFact>& facts) {
  addLines(materialText(material), "material", facts);
}

void addOutputFacts(const RunOptions& options, std::vector<RunFact>& facts) {
  const auto add = [&](const std::string& name, auto value) {
    facts.push_back({name, fmt::format("{}", value)});
  };
  for (const AnimationFormat& format : animationFormats()) {
    if (!format.hasPrecisions)  // the precision of the cache is a fact of its own
      add(fmt::format("hair{}", format.extension),
          std::ranges::count(options.animations, format.extension) > 0);
  }
  add("hair.rgc", options.cache ? static_cast<int>(*options.cache) : -1);
  add("sheet.png", options.writesSheet);
  add("width", options.width);
  add("tip_width", options.tipWidth.value_or(0));
  add("USD values", fmt::format("{}", fmt::join(options.values, ", ")));
  add("head", static_cast<int>(options.usdHead));
  add("groom's prims", options.usesGroomPrims);
  add("clip_frames", options.clipFrames);
  add("hairs", options.hairs);
  add("frizz", options.look.of({}).frizz);
  add("clump", options.look.of({}).gather);
  add("blend", options.look.of({}).blend);
  add("hair_scalp_file", options.look.scalp.string());
}

}  // namespace ringlet
