// What is behind the handles of c/ringlet_io.h.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ringlet/c/handles.h"
#include "ringlet/c/ringlet_io.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet::c {

/// A groom as ringlet_groom shows it.
struct ShownGroom {
  Groom groom;
  std::vector<std::uint32_t> sizes{};

  explicit ShownGroom(Groom of);
  ringlet_groom show() const;
};

}  // namespace ringlet::c

struct ringlet_loaded_groom {
  ringlet::c::ShownGroom shown;
};
struct ringlet_mesh {
  std::vector<float> vertices;
  std::vector<std::uint32_t> triangles;
};
struct ringlet_scene {
  std::shared_ptr<const ringlet::LoadedScene>
      loaded;  // assets and hair of it keep it, to be told from others'
  ringlet::c::ShownGroom shown;
  ringlet::SceneFile file;
  std::filesystem::path path{};  // of it; empty: a text
};
struct ringlet_animation {
  std::filesystem::path path;
  std::unique_ptr<ringlet::AnimationWriter> writer;  // none: finished
  std::uint64_t particleCount;
  std::uint32_t mostFrames;
  double metresPerUnit;
};
struct ringlet_frames {
  ringlet::AnimationReader reader;
  int latest = 0;
};
